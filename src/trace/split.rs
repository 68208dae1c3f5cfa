//! The text of a trace, split into the text of its records.

use std::io::{self, BufRead, Read};

use super::format::Layout;

/// Bytes of the longest record that is read: twice what a frame of ten million agents in space
/// takes. Without an end, a stream that has no line ends would fill the memory.
const LONGEST: usize = 2 << 30;

/// Cuts a stream into the texts of records, in either layout, and counts lines.
pub(super) struct Splitter<R> {
    input: R,
    layout: Layout,
    /// Line that is being read, from 1.
    line: u64,
    /// What may come next in an array.
    expected: Expected,
    text: Vec<u8>,
    /// Bytes of the longest record.
    longest: usize,
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
            longest: LONGEST,
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
            let most = self.longest as u64 + 1;
            let input = &mut self.input;
            if input
                .by_ref()
                .take(most)
                .read_until(b'\n', &mut self.text)?
                == 0
            {
                return Ok(None);
            }
            if self.text.len() > self.longest {
                return Err(self.too_long(self.line));
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
                    return self.take_object().map(Some);
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

    fn too_long(&self, line: u64) -> Fault {
        let problem = format!(
            "a record is longer than {} bytes, which is all that one may take",
            self.longest
        );
        Fault::Stray { line, problem }
    }

    /// Takes the object that begins here, up to the brace that closes it.
    fn take_object(&mut self) -> Result<Piece<'_>, Fault> {
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
            if self.text.len() + taken > self.longest {
                return Err(self.too_long(line));
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The lengths of the pieces, or what is wrong.
    fn pieces(text: impl Read, layout: Layout) -> Result<Vec<usize>, String> {
        let mut splitter = Splitter::new(io::BufReader::new(text), layout);
        splitter.longest = 30;
        let mut lengths = Vec::new();
        loop {
            match splitter.next() {
                Ok(Some(piece)) => lengths.push(piece.text.trim_ascii().len()),
                Ok(None) => return Ok(lengths),
                Err(Fault::Stray { line, problem }) => return Err(format!("{line}: {problem}")),
                Err(Fault::Io(error)) => return Err(error.to_string()),
            }
        }
    }

    #[test]
    fn a_record_without_end_is_refused() {
        let long = |length: usize| format!("{{\"a\":\"{}\"}}", "x".repeat(length - 8));
        let too_long = "is longer than 30 bytes";
        for layout in [Layout::Lines, Layout::Array] {
            let all = |records: &[String]| match layout {
                Layout::Lines => records.join("\n"),
                Layout::Array => format!("[{}]", records.join(",\n")),
            };
            let fits = all(&[long(20), long(30)]);
            assert_eq!(pieces(fits.as_bytes(), layout), Ok(vec![20, 30]));
            let beyond = pieces(all(&[long(20), long(31)]).as_bytes(), layout).unwrap_err();
            assert!(
                beyond.starts_with("2: ") && beyond.contains(too_long),
                "{beyond}"
            );
            let start: &[u8] = if layout == Layout::Lines { b"{" } else { b"[{" };
            let endless = pieces(start.chain(io::repeat(b'x')), layout).unwrap_err();
            assert!(endless.contains(too_long), "{endless}");
        }
        assert!(
            pieces(io::repeat(b' '), Layout::Lines)
                .unwrap_err()
                .contains(too_long)
        );
    }
}
