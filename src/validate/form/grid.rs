//! Columns of text.

use super::words::WIDTH;

/// Rows of cells as lines, the columns aligned. The first column takes no more than its share
/// of the page: a longer cell has a line of its own above the rest of its row.
pub(super) fn aligned(rows: &[Vec<String>]) -> Vec<String> {
    let length = |cell: &String| cell.chars().count();
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widest = |column: usize| {
        rows.iter()
            .filter_map(|row| row.get(column).map(length))
            .max()
    };
    let mut widths: Vec<usize> = (0..columns).map(|k| widest(k).unwrap_or(0)).collect();
    let rest: usize = widths.iter().skip(1).map(|width| width + 2).sum();
    if let Some(first) = widths.first_mut() {
        *first = (*first).min(WIDTH.saturating_sub(rest).max(20));
    }
    rows.iter().map(|row| line(row, &widths)).collect()
}

fn line(row: &[String], widths: &[usize]) -> String {
    let mut out = String::new();
    for (k, (cell, width)) in row.iter().zip(widths).enumerate() {
        if k == 0 && cell.chars().count() > *width {
            out += &format!("{cell}\n{:width$}  ", "");
        } else {
            out += &format!("{cell:width$}  ");
        }
    }
    out.truncate(out.trim_end().len());
    out.push('\n');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_below_one_another() {
        let row = |cells: [&str; 3]| cells.map(str::to_owned).to_vec();
        let long = "x".repeat(120);
        let lines = aligned(&[row(["a", "bb", ""]), row([&long, "ü", "c"])]);
        assert_eq!(lines[0].find("bb"), Some(WIDTH - 4 - 3 + 2));
        let (name, rest) = lines[1].split_once('\n').unwrap();
        assert_eq!(name, long);
        assert_eq!(rest.find('ü'), lines[0].find("bb"));
        assert!(rest.ends_with("c\n"));
    }
}
