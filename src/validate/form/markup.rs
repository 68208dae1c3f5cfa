//! Letters of HTML and SVG, written so that XML readers understand them too.

/// Text in which nothing is taken for markup, in attributes as well. Letters that XML has not
/// got are shown as the sign for what cannot be shown.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            '\n' | '\t' => out.push(c),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ if c.is_control() => out.push('\u{fffd}'),
            _ => out.push(c),
        }
    }
    out
}

/// An element with text in it.
pub(super) fn element(name: &str, text: &str) -> String {
    format!("<{name}>{}</{name}>", escape(text))
}

/// A row of a table: the first cell heads it; cells are markup.
pub(super) fn row(cells: &[String]) -> String {
    let mut out = "<tr>".to_owned();
    for (k, cell) in cells.iter().enumerate() {
        out += &match k {
            0 => format!("<th scope=\"row\">{cell}</th>"),
            _ => format!("<td>{cell}</td>"),
        };
    }
    out + "</tr>\n"
}

/// A table of rows that are markup, with its headings and its caption.
pub(super) fn table(caption: &str, headings: &[&str], rows: &str) -> String {
    let headings = headings.iter();
    let headings: String = headings
        .map(|it| format!("<th scope=\"col\">{}</th>", escape(it)))
        .collect();
    // A wide table scrolls by itself, and not the page.
    format!(
        "<div class=\"wide\"><table>\n<caption>{}</caption>\n<thead><tr>{headings}</tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table></div>\n",
        escape(caption)
    )
}
