//! Numbers for people to read.

/// A number in so many digits, with an exponent only where it is very large or small.
pub(crate) fn digits(value: f64, count: usize) -> String {
    if !value.is_finite() {
        return format!("{value}");
    }
    let rounded = format!("{value:.*e}", count.saturating_sub(1));
    let (mantissa, exponent) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trim = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    match exponent {
        _ if value == 0.0 => "0".to_owned(),
        -3..=5 => {
            let decimals = (count as i32 - 1 - exponent).max(0) as usize;
            trim(&format!("{value:.decimals$}"))
        }
        _ => format!("{}e{exponent}", trim(mantissa)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.123456, "0.1235"),
            (99_999.6, "100000"),
            (-0.00123456, "-0.001235"),
            (0.00099999, "0.001"),
            (1.5e-9, "1.5e-9"),
            (1e300, "1e300"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(digits(value, 4), text);
        }
        assert_eq!(digits(1000.0025, 8), "1000.0025");
        assert_eq!(digits(-0.98765, 3), "-0.988");
    }
}
