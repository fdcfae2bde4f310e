//! Pages that need nothing beside them: no other file, no network. They are well-formed XML. Their script adds to what is there:
//! without it a page reads as it does on paper.

/// Style of all pages: light and dark, on a screen and on paper.
const STYLE: &str = include_str!("style.css");
/// Script of all pages: it needs no other file either.
const SCRIPT: &str = include_str!("page.js");

/// A cell with more letters is wide, so that it is not high.
const LONG: usize = 60;

/// A whole page.
pub fn document(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        escape(title)
    )
}

/// What stands first on a page: of what kind it is, and what it is called.
pub fn header(kind: &str, name: &str) -> String {
    format!("<header>\n<p class=\"kind\">{}</p>\n<h1>{}</h1>\n</header>\n", escape(kind), escape(name))
}

/// A heading with a place that links of the page lead to.
pub fn section(place: &str, text: &str) -> String {
    format!("<h2 id=\"{place}\">{}</h2>\n", escape(text))
}

/// A smaller heading.
pub fn subsection(text: &str) -> String {
    format!("<h3>{}</h3>\n", escape(text))
}

/// A paragraph.
pub fn paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", escape(text))
}

/// A list of sentences; nothing if there are none.
pub fn list<S: AsRef<str>>(sentences: &[S]) -> String {
    let items: String = sentences.iter().map(|text| format!("<li>{}</li>\n", escape(text.as_ref()))).collect();
    if items.is_empty() { items } else { format!("<ul>\n{items}</ul>\n") }
}

/// A table; nothing if it has no row. Numbers stand at the right of their cells.
pub fn table<S: AsRef<str>>(header: &[S], rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let is_right = |column: usize| {
        let mut cells = rows.iter().filter_map(|row| row.get(column)).filter(|cell| !is_empty(cell)).peekable();
        cells.peek().is_some() && cells.all(|cell| is_number(cell))
    };
    let right: Vec<bool> = (0..header.len()).map(is_right).collect();
    let class = |column: usize| if right.get(column) == Some(&true) { " class=\"number\"" } else { "" };
    let cell = |(column, text): (usize, &String)| match judged(text) {
        Some(class) => format!("<td class=\"{class}\">{}</td>", escape(text)),
        None if text.chars().count() > LONG => format!("<td class=\"long\">{}</td>", escape(text)),
        None => format!("<td{}>{}</td>", class(column), escape(text)),
    };
    let row = |cells: &Vec<String>| format!("<tr>{}</tr>\n", cells.iter().enumerate().map(cell).collect::<String>());
    let names = header.iter().enumerate().map(|(column, name)| format!("<th{}>{}</th>", class(column), escape(name.as_ref())));
    format!(
        "<div class=\"wide\">\n<table>\n<tr>{}</tr>\n{}</table>\n</div>\n",
        names.collect::<String>(),
        rows.iter().map(row).collect::<String>()
    )
}

/// A figure, given by the text of its file, with words below it.
pub fn figure(svg: &str, words: &str) -> String {
    let svg = svg.trim().replacen("<svg ", &format!("<svg role=\"img\" aria-label=\"{}\" ", escape(words)), 1);
    format!("<figure>\n{svg}\n<figcaption>{}</figcaption>\n</figure>\n", escape(words))
}

/// Figures side by side, as many as there is room for.
pub fn grid(figures: impl Iterator<Item = String>) -> String {
    format!("<div class=\"grid\">\n{}</div>\n", figures.collect::<String>())
}

/// Something that a reader unfolds.
pub fn folded(title: &str, content: &str) -> String {
    format!("<details>\n<summary>{}</summary>\n{content}</details>\n", escape(title))
}

/// Text as it stands in a file.
pub fn verbatim(text: &str) -> String {
    format!("<pre>{}</pre>\n", escape(text))
}

/// Text that is no markup: names come from files. Letters that XML does not know are left out.
pub fn escape(text: &str) -> String {
    let is_text =
        |letter: &char| !letter.is_control() && !matches!(letter, '\u{fffe}' | '\u{ffff}') || matches!(letter, '\n' | '\t');
    let visible: String = text.chars().filter(is_text).collect();
    visible.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;").replace('\'', "&#39;")
}

/// What stands in a cell for what is not known.
pub const UNKNOWN: &str = "–";
/// Words of cells that say whether something holds; each has a colour.
pub const HOLDS: &str = "holds";
/// The opposite.
pub const MISSED: &str = "missed";
/// A result that is to be trusted.
pub const TRUSTED: &str = "trusted";
/// The opposite.
pub const NOT_TRUSTED: &str = "not trusted";
/// Neither.
pub const UNTOLD: &str = "nothing tells";

fn judged(cell: &str) -> Option<&'static str> {
    match cell {
        HOLDS | TRUSTED => Some("good"),
        MISSED | NOT_TRUSTED => Some("bad"),
        UNTOLD => Some("open"),
        _ => None,
    }
}

fn is_empty(cell: &str) -> bool {
    cell.is_empty() || cell == UNKNOWN
}

fn is_number(cell: &str) -> bool {
    let digits = cell.trim_start_matches(['-', '−', '(', '<', ' ']);
    digits.starts_with(|first: char| first.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_no_markup() {
        let name = "<script>alert('x')</script> & \"y\"\u{1b}\u{0}\u{ffff}";
        let text = "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; &quot;y&quot;";
        assert_eq!(escape(name), text);
        let page = document(name, &(section("a", name) + &paragraph(name) + &list(&[name]) + &figure("<svg ></svg>", name)));
        assert!(page.matches("<script").count() == 1 && page.matches("&lt;script&gt;").count() == 6, "{page}");
        assert!(table(&[name], &[vec![name.into()]]).matches(text).count() == 2);
    }

    #[test]
    fn columns_of_numbers_stand_at_the_right() {
        let rows = [["seam", "1.5", "2"], ["−seat", "−3", UNKNOWN]].map(|row| row.map(String::from).to_vec());
        let text = table(&["name", "force", "count"], &rows);
        assert_eq!(text.matches("class=\"number\"").count(), 6, "{text}");
        assert!(text.contains("<td>seam</td>") && text.contains("<td>−seat</td>"));
        assert_eq!(table::<&str>(&["name"], &[]), "");
        assert!(table(&["a"], &[vec![MISSED.into()]]).contains("class=\"bad\""));
        assert!(table(&["reason"], &[vec!["a reason ".repeat(9)]]).contains("<td class=\"long\">a reason"));
    }
}
