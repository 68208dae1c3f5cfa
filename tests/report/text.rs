//! The table for a terminal, and the Markdown document.

use volary::claim::Verdict;
use volary::validate::form::{markdown, table};

use crate::sample::{LONG, full, report, single};

const TOTAL: &str = "12 findings: 5 hold, 2 violated (1 expected), 3 hypotheses not met, \
                     2 undecided; 2 not as expected";

/// The lines of a text with their words parted by single spaces.
fn squeezed(text: &str) -> Vec<String> {
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    text.lines().map(words).collect()
}

#[test]
fn the_table_says_what_came_of_each_claim() {
    let text = table(&full());
    let lines = squeezed(&text);
    for line in [
        "song-2013/cucker-dong: 20 agents in 3-D to time 40",
        "bodies in steps of 0.01; 241 states; 1 contact between agents, the first at time 21.5; closest",
        "claim reading points bodies",
        "theorem-10-energy printed violated -0.0074 holds 0.02",
        "points, as expected: W(t) is 13.7 at time 0, above 13.6",
        "theorem-10-distance sharpened holds 0.66 not met 0.66",
        "both: it has not come near enough to 0",
        "theorem-10-envelope corrected holds 0.3 –",
        "acceleration-bound printed holds 0.5 violated -1.5e-9 !",
        "bodies, not as expected (no violation): |a_i| is 1.2 at time 0, above 1",
        "song-2013: not met: <no> other | forces_act:",
        "without contact in theory up to radius 0.155, half of P⁻¹(W(0)) = 0.31, by",
        "without contact as points up to radius 0.4",
        "first contact at time 21.5, agents 3 and 17, approaching at 0.25, with a blow of",
        "1.5; as points these are 0.98 apart; the bodies are larger than",
        "bodies depart from points by 2e-5 before the first contact (velocities by 3e-4), and by 0.7",
        "no claim has anything to say of this world",
        "no claim keeps agents apart in this world",
        TOTAL,
    ] {
        let found = lines.iter().any(|it| it.contains(line));
        assert!(found, "{line:?} is not in\n{text}");
    }
    assert_eq!(lines.last().map(String::as_str), Some(TOTAL));
    let wide = text.lines().find(|line| line.chars().count() > 100);
    assert_eq!(wide, None);
}

#[test]
fn columns_stand_below_their_headings() {
    let text = table(&single());
    let column = |line: &str, word: &str| {
        let before = line.split(word).next().unwrap();
        before.chars().count()
    };
    let line = |start: &str| {
        let found = text.lines().find(|it| it.trim_start().starts_with(start));
        found.unwrap_or_else(|| panic!("no {start} in\n{text}"))
    };
    let (heading, row) = (line("claim "), line("theorem-10-distance "));
    assert_eq!(column(heading, "points"), column(row, "holds"));
    assert_eq!(column(heading, "bodies"), column(row, "not met"));
    // A name that fits in no column stands above its row.
    let mut report = full();
    report.worlds[1].claims[0].findings[0].finding.verdict = Verdict::Holds;
    let text = table(&report);
    let mut lines = text.lines();
    let name = LONG.split_once('/').unwrap().1;
    lines.find(|it| it.trim_end() == format!("    {name}"));
    let below = lines.next().unwrap().trim_start();
    assert!(below.starts_with("printed"), "{below} in\n{text}");
}

#[test]
fn several_worlds_have_an_overview() {
    let text = table(&full());
    let lines = squeezed(&text);
    let start = lines.iter().position(|it| it == "3 worlds").unwrap();
    let find = |line: &str| {
        let found = lines[start..].iter().position(|it| it.starts_with(line));
        found.unwrap_or_else(|| panic!("{line:?} is not in\n{text}"))
    };
    // In the order of the program's list, not of the worlds.
    let known = find("acceleration-bound printed 1 · · · · 1 · ·");
    let other = find("theorem-10-energy printed · 1 · · 1 · · ·");
    assert!(known < other);
    assert_eq!(
        lines[start + other + 1],
        "violated in song-2013/cucker-dong (points)"
    );
    // A claim that is met nowhere has no row.
    find(&format!("Met in no world: {LONG}."));
    find("song-2013/cucker-dong 0.5 0.155 0.4 0.49 21.5 2e-5 0.7");
    assert!(!table(&single()).contains("viol."), "one world needs none");
}

#[test]
fn a_report_of_nothing_says_so() {
    let none = "0 findings: 0 hold, 0 violated (0 expected), 0 hypotheses not met, 0 undecided; \
                0 not as expected\n";
    assert_eq!(table(&report(Vec::new())), none);
    assert!(markdown(&report(Vec::new())).starts_with("# Validation\n\n0 worlds, by volary"));
}

/// The cells of a row, parted by bars that are not escaped.
fn cells(row: &str) -> usize {
    row.replace("\\\\", "")
        .replace("\\|", "")
        .matches('|')
        .count()
}

#[test]
fn the_document_has_the_same_in_tables() {
    let text = markdown(&full());
    for line in [
        "| `song-2013/theorem-10-energy` | printed | **violated** -0.0074 | holds 0.02 | points, \
         as expected: W(t) is 13.7 at time 0, above 13.6 |",
        "| `song-2013/theorem-10-energy` | Song, Liu, Cao &amp; Qiu, Theorem 10 | printed | \
         **1 violated** | 1 holds | `song-2013/cucker-dong` (points) |",
        "| `song-2013/theorem-10-envelope` | corrected | holds 0.3 | – |  |",
        "| `song-2013/cucker-dong` | 0.5 | 0.155 | 0.4 | 0.49 | 21.5 | 2e-5 | 0.7 |",
        "not met: &lt;no&gt; other \\| forces\\_act",
        "## &lt;b&gt;&amp;\"it's\"&lt;/b&gt; \\| \\`a\\_b\\*\\` \\\\ \\]\\]&gt;",
        "- bodies depart from points: by 2e-5 before the first contact",
        TOTAL,
    ] {
        assert!(text.contains(line), "{line:?} is not in\n{text}");
    }
    assert!(!text.replace("<br>", "").contains('<'));
    // Rows have as many cells as their headings.
    let mut expected = None;
    for line in text.lines() {
        match line.starts_with('|') {
            true => assert_eq!(cells(line), *expected.get_or_insert(cells(line)), "{line}"),
            false => expected = None,
        }
    }
    assert!(
        !markdown(&single()).contains("## Claims"),
        "one world needs none"
    );
}
