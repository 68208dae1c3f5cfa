//! Checks of numbers that change with time.

use super::{Check, LARGEST};
use crate::world::problem::Problem;
use crate::world::spec::{TimeFunctionSpec, VaryingSpec};
use crate::world::words::number;

/// How deep sums and products may stand in each other.
const DEEPEST: usize = 2;

impl Check {
    /// Checks a function of time whose values must be `least` or more; of sums and products,
    /// what their parts may come to together counts.
    pub(super) fn time_function(
        &mut self,
        path: &str,
        function: &TimeFunctionSpec,
        least: Option<f64>,
    ) {
        let known = self.problems.len();
        self.form_of_time_function(path, function, DEEPEST);
        // What is no function has no least value.
        if let Some(least) = least.filter(|_| self.problems.len() == known)
            && let [lowest, _] = function.function().bounds()
            && lowest < least
        {
            let what = match function {
                TimeFunctionSpec::Constant(_) => format!("must be at least {}", number(least)),
                TimeFunctionSpec::Varying(_) => format!(
                    "may fall to {}, but must be at least {}",
                    number(lowest),
                    number(least)
                ),
            };
            self.add(path, what);
        }
    }

    /// Whether it is a function at all.
    fn form_of_time_function(&mut self, path: &str, function: &TimeFunctionSpec, depth: usize) {
        let varying = match function {
            TimeFunctionSpec::Constant(value) => return self.numbers(path, &[*value]),
            TimeFunctionSpec::Varying(varying) => varying,
        };
        match varying {
            VaryingSpec::Table { times, values, .. } => {
                self.increasing(&format!("{path}.table.times"), times);
                self.numbers(&format!("{path}.table.values"), values);
                if values.len() != times.len() {
                    let (needed, found) = (times.len(), values.len());
                    let what = format!("must have {needed} values, one for each time, not {found}");
                    self.add(format!("{path}.table.values"), what);
                }
            }
            VaryingSpec::Sine { .. }
            | VaryingSpec::Square { .. }
            | VaryingSpec::Exponential { .. } => {}
            VaryingSpec::Sum(parts) => self.parts(&format!("{path}.sum"), parts, depth),
            VaryingSpec::Product(parts) => self.parts(&format!("{path}.product"), parts, depth),
        }
    }

    fn parts(&mut self, path: &str, parts: &[TimeFunctionSpec], depth: usize) {
        let Some(depth) = depth.checked_sub(1) else {
            let what = "stands too deep: a sum of products or a product of sums goes no deeper";
            return self.add(path, what);
        };
        for (index, part) in parts.iter().enumerate() {
            self.form_of_time_function(&format!("{path}[{index}]"), part, depth);
        }
    }

    /// Times must increase from each to the next.
    pub(super) fn increasing(&mut self, path: &str, times: &[f64]) {
        self.numbers(path, times);
        for (index, pair) in times.windows(2).enumerate() {
            if pair[0] >= pair[1] {
                let what = format!("must be later than {}, the time before", number(pair[0]));
                self.add(format!("{path}[{}]", index + 1), what);
            }
        }
    }

    /// Numbers in lists must stay finite when multiplied; the schema looks at fields only.
    pub(super) fn numbers(&mut self, path: &str, numbers: &[f64]) {
        if !numbers.iter().all(|x| x.abs() <= LARGEST) {
            let problem = Problem::new(path, "holds a number too large to compute with");
            self.problems.push(problem.allowed("-1e100 to 1e100"));
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn problems(function: serde_json::Value, least: Option<f64>) -> Vec<(String, String)> {
        let mut check = Check::new(2, 0.01, 1);
        check.time_function("f", &serde_json::from_value(function).unwrap(), least);
        let found = check.problems.into_iter();
        found.map(|problem| (problem.path, problem.what)).collect()
    }

    fn one(path: &str, what: &str) -> Vec<(String, String)> {
        vec![(path.into(), what.into())]
    }

    #[test]
    fn tables_need_increasing_times_and_as_many_values() {
        let table = |times: &[f64], values: &[f64]| {
            problems(
                json!({ "table": { "times": times, "values": values } }),
                None,
            )
        };
        assert_eq!(table(&[0.0, 1.0], &[5.0, -2.0]), []);
        assert_eq!(
            table(&[0.0, 1.0, 1.0], &[1.0; 3]),
            one("f.table.times[2]", "must be later than 1, the time before")
        );
        assert_eq!(
            table(&[0.0, 1.0], &[1.0]),
            one(
                "f.table.values",
                "must have 2 values, one for each time, not 1"
            )
        );
        assert_eq!(
            table(&[0.0], &[1e101]),
            one("f.table.values", "holds a number too large to compute with")
        );
    }

    #[test]
    fn values_below_the_least_are_refused_wherever_they_come_from() {
        assert_eq!(problems(json!(0), Some(0.0)), []);
        assert_eq!(problems(json!(-1), None), []);
        assert_eq!(
            problems(json!(-1), Some(0.0)),
            one("f", "must be at least 0")
        );
        let sine = json!({ "sine": { "mean": 1, "amplitude": 1.5, "period": 2 } });
        let falls = "may fall to -0.5, but must be at least 0";
        assert_eq!(problems(sine.clone(), Some(0.0)), one("f", falls));
        assert_eq!(
            problems(json!({ "sum": [sine.clone(), 0.5] }), Some(0.0)),
            []
        );
        let settling = |end: f64| json!({ "exponential": { "start": 1, "end": end, "time": 2 } });
        assert_eq!(problems(settling(0.0), Some(0.0)), []);
        assert_eq!(problems(settling(-0.5), Some(0.0)), one("f", falls));
        assert_eq!(
            problems(json!({ "product": [sine, 1] }), Some(0.0)),
            one("f", falls)
        );
    }

    #[test]
    fn sums_of_products_go_no_deeper() {
        let deep = json!({ "sum": [{ "product": [2, 3] }, 1] });
        assert_eq!(problems(deep.clone(), None), []);
        let deeper = problems(json!({ "product": [1, deep] }), None);
        assert_eq!(deeper[0].0, "f.product[1].sum[0].product");
        assert_eq!(deeper.len(), 1);
    }
}
