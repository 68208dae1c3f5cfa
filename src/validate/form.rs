//! stub
#![allow(missing_docs)]
use super::report::Report;
use crate::trace::TraceError;
use std::path::Path;
pub fn table(report: &Report) -> String {
    let mut t = String::new();
    for w in &report.worlds {
        t += &format!("{} {:?}\n", w.world, w.runs);
        for c in &w.claims {
            for f in &c.findings {
                t += &format!(
                    "  {:60} {:?} {:?} {:?} exp={} {}\n",
                    c.claim,
                    f.dynamics,
                    f.finding.verdict,
                    f.finding.margin,
                    f.as_expected,
                    f.finding.reason
                );
            }
        }
        let mut c = w.contact.clone();
        if let Some(d) = c.as_mut().and_then(|c| c.departure.as_mut()) {
            d.times.clear();
            d.distances.clear();
        }
        t += &format!("{:#?}\n", c);
    }
    t
}
pub fn write(_: &Path, _: &Report, _: bool) -> Result<(), TraceError> {
    Ok(())
}
pub fn check(_: &Path, _: bool) -> Result<(), TraceError> {
    Ok(())
}
