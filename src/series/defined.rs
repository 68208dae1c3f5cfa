//! Quantities that have values.

use super::{Quantity, Run, SeriesError};

/// Refuses quantities without a value in any frame of a run, whose courses are theirs, in their
/// order.
///
/// # Errors
/// The first of them.
pub fn demand(runs: &[Run], quantities: &[Quantity]) -> Result<(), SeriesError> {
    for run in runs {
        let mut pairs = quantities.iter().zip(&run.courses);
        if let Some((quantity, _)) = pairs.find(|(_, course)| course.is_empty()) {
            return Err(SeriesError::Undefined {
                name: run.name.clone(),
                quantity: quantity.name().to_owned(),
                reason: match quantity.stem() {
                    "target_error" => ": no law of its world gives agents a target",
                    _ => "",
                }
                .to_owned(),
            });
        }
    }
    Ok(())
}

/// Drops quantities without a value in any frame of any run, with their courses, which are
/// theirs, in their order.
///
/// # Errors
/// None is left.
pub fn drop_undefined(runs: &mut [Run], quantities: &mut Vec<Quantity>) -> Result<(), SeriesError> {
    let defined = |k: usize| runs.iter().any(|run| !run.courses[k].is_empty());
    let defined: Vec<bool> = (0..quantities.len()).map(defined).collect();
    if !defined.contains(&true) {
        return demand(runs, quantities);
    }
    for run in runs {
        retain(&mut run.courses, &defined);
        retain(&mut run.starts, &defined);
    }
    retain(quantities, &defined);
    Ok(())
}

fn retain<T>(entries: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    entries.retain(|_| kept.next() == Some(&true));
}
