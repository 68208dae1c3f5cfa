//! Pages that show figures beside what is said of them.

use super::{Figure, Sketch};
use crate::picture::Theme;
use crate::validate::form::{escape_html as escape, escape_markdown as plain};

const STYLE: &str = "body { font: 16px/1.5 \"DejaVu Sans\", sans-serif; max-width: 70em; \
    margin: 2em auto; padding: 0 1em; }\nfigure { margin: 0 0 1em; }\nimg { max-width: 100%; \
    height: auto; }\n";

/// The heading of those not made.
const SKETCHES: &str = "Sketches, which show no result";

/// A page of HTML that shows figures, each from the file that it is in, with what the paper shows
/// and what ours shows, and lists the sketches; all in the colours of a theme.
pub fn html(figures: &[(&Figure, String)], sketches: &[Sketch], theme: &Theme) -> String {
    let colors = format!(
        ":root {{ background: {}; color: {}; }}\n",
        theme.page, theme.ink
    );
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta \
         name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>Figures</title>\n\
         <style>\n{STYLE}{colors}</style>\n</head>\n<body>\n<h1>Figures</h1>\n"
    );
    for (figure, file) in figures {
        out += &format!(
            "<h2 id=\"{}\">{}</h2>\n<figure><img src=\"{}\" alt=\"{}\"/></figure>\n\
             <p><b>Paper:</b> {}</p>\n<p><b>Ours:</b> {}</p>\n",
            escape(figure.id),
            escape(figure.source),
            escape(file),
            escape(figure.source),
            escape(figure.caption),
            escape(&figure.finding),
        );
    }
    if !sketches.is_empty() {
        out += &format!("<h2>{SKETCHES}</h2>\n<ul>\n");
        for sketch in sketches {
            out += &format!(
                "<li>{}: {}</li>\n",
                escape(sketch.source),
                escape(sketch.reason)
            );
        }
        out += "</ul>\n";
    }
    out + "</body>\n</html>\n"
}

/// The same in Markdown.
pub fn markdown(figures: &[(&Figure, String)], sketches: &[Sketch]) -> String {
    let mut out = "# Figures\n".to_owned();
    for (figure, file) in figures {
        out += &format!(
            "\n## {0}\n\n![{0}]({file})\n\n- Paper: {1}\n- Ours: {2}\n",
            figure.source,
            plain(figure.caption),
            plain(&figure.finding),
        );
    }
    if !sketches.is_empty() {
        out += &format!("\n## {SKETCHES}\n\n");
        for sketch in sketches {
            out += &format!("- {}: {}\n", sketch.source, plain(sketch.reason));
        }
    }
    out
}
