use crate::sample::*;
use volary::validate::form::{markdown, table};
#[test]
fn show() {
    println!("{}", table(&full()));
    println!("{}", markdown(&full()));
    std::fs::write(
        "/tmp/report-page.html",
        volary::validate::form::html(&full()),
    )
    .unwrap();
}
