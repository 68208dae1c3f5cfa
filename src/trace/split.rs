//! The text of a trace, split into the text of its records.

use std::io::{self, BufRead};

use super::format::Layout;

/// Cuts a stream into the texts of records, in either layout, and counts lines.
pub(super) struct Splitter<R> {
    input: R,
    layout: Layout,
    /// Line that is being read, from 1.
    line: u64,
    /// What may come next in an array.
    expected: Expected,
    text: Vec<u8>,
}

/// The text of one record.
pub(super) struct Piece<'a> {
    pub text: &'a [u8],
    /// Line on which it begins.
    pub line: u64,
    /// Whether its end was seen, not just the end of the stream.
    pub closed: bool,
}

/// Why there is no next piece.
pub(super) enum Fault {
    Io(io::Error),
    /// Something between the elements of an array that does not belong there.
    Stray {
        line: u64,
        problem: String,
    },
}

impl From<io::Error> for Fault {
    fn from(e: io::Error) -> Self {
        Self::Io(e)
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Expected {
    Opening,
    FirstElement,
    Separator,
    Element,
    Nothing,
}

impl<R: BufRead> Splitter<R> {
    pub fn new(input: R, layout: Layout) -> Self {
        Self {
            input,
            layout,
            line: 1,
            expected: Expected::Opening,
            text: Vec::new(),
        }
    }

    /// The next piece; none at the end of the stream.
    pub fn next(&mut self) -> Result<Option<Piece<'_>>, Fault> {
        self.text.clear();
        match self.layout {
            Layout::Lines => self.next_line(),
            Layout::Array => self.next_element(),
        }
    }

    fn next_line(&mut self) -> Result<Option<Piece<'_>>, Fault> {
        while self.text.trim_ascii().is_empty() {
            self.text.clear();
            if self.input.read_until(b'\n', &mut self.text)? == 0 {
                return Ok(None);
            }
            self.line += 1;
        }
        Ok(Some(Piece {
            text: &self.text,
            line: self.line - 1,
            closed: self.text.ends_with(b"\n"),
        }))
    }

    /// Steps over brackets and commas, strictly, to the next object. The elements
    /// may lie on any lines: other programs format JSON in their own ways.
    fn next_element(&mut self) -> Result<Option<Piece<'_>>, Fault> {
        use Expected::{Element, FirstElement, Nothing, Opening, Separator};
        while let Some(&byte) = self.input.fill_buf()?.first() {
            self.expected = match (byte, self.expected) {
                (b'{', FirstElement | Element) => {
                    self.expected = Separator;
                    return self.take_object().map(Some).map_err(Fault::Io);
                }
                (b'[', Opening) => FirstElement,
                (b',', Separator) => Element,
                (b']', FirstElement | Separator) => Nothing,
                (b'\n', expected) => {
                    self.line += 1;
                    expected
                }
                (b' ' | b'\t' | b'\r', expected) => expected,
                (_, expected) => {
                    let problem = match expected {
                        Opening => "expected [",
                        FirstElement | Element => "expected a record",
                        Separator => "expected a comma or ] behind a record",
                        Nothing => "expected nothing behind the last ]",
                    };
                    return Err(Fault::Stray {
                        line: self.line,
                        problem: problem.to_owned(),
                    });
                }
            };
            self.input.consume(1);
        }
        Ok(None)
    }

    /// Takes the object that begins here, up to the brace that closes it.
    fn take_object(&mut self) -> io::Result<Piece<'_>> {
        let line = self.line;
        let (mut depth, mut in_string, mut escaped, mut closed) = (0_usize, false, false, false);
        while !closed {
            let bytes = self.input.fill_buf()?;
            if bytes.is_empty() {
                break;
            }
            let end = bytes.iter().position(|&byte| {
                match byte {
                    _ if escaped => escaped = false,
                    b'\\' if in_string => escaped = true,
                    b'"' => in_string = !in_string,
                    b'{' if !in_string => depth += 1,
                    b'}' if !in_string => depth -= 1,
                    b'\n' => self.line += 1,
                    _ => {}
                }
                depth == 0
            });
            closed = end.is_some();
            let taken = end.map_or(bytes.len(), |last| last + 1);
            self.text.extend_from_slice(&bytes[..taken]);
            self.input.consume(taken);
        }
        Ok(Piece {
            text: &self.text,
            line,
            closed,
        })
    }
}
