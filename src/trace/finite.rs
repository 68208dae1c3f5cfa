//! Search for numbers that JSON cannot hold.
//!
//! serde_json turns NaN and infinities into `null` without a word. The walk below
//! visits a value by way of serde, as the writer itself does, so a field added to
//! the records later is checked as well.

use std::fmt;

use serde::{Serialize, Serializer, ser};

/// Fails on the first number of `value` that is not finite.
pub(super) fn check<T: Serialize + ?Sized>(value: &T) -> Result<(), NonFinite> {
    value.serialize(Walk)
}

/// A number that is not finite, and the way to it.
#[derive(Debug)]
pub(super) struct NonFinite {
    /// Steps to the number, the last first.
    steps: Vec<Step>,
    problem: String,
}

#[derive(Debug)]
enum Step {
    Field(&'static str),
    Index(usize),
}

impl NonFinite {
    fn new(problem: impl fmt::Display) -> Self {
        Self {
            steps: Vec::new(),
            problem: problem.to_string(),
        }
    }

    /// The same, seen from one level higher.
    fn inside(mut self, step: Step) -> Self {
        self.steps.push(step);
        self
    }
}

impl fmt::Display for NonFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (depth, step) in self.steps.iter().rev().enumerate() {
            match step {
                Step::Field(name) if depth == 0 => f.write_str(name)?,
                Step::Field(name) => write!(f, ".{name}")?,
                Step::Index(index) => write!(f, "[{index}]")?,
            }
        }
        write!(f, " is {}", self.problem)
    }
}

impl std::error::Error for NonFinite {}

impl ser::Error for NonFinite {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(message)
    }
}

type Outcome = Result<(), NonFinite>;

struct Walk;

/// The elements of a list, tuple or map; counts them.
struct Elements(usize);

/// The fields of a struct.
struct Fields;

impl Elements {
    fn visit<T: Serialize + ?Sized>(&mut self, value: &T) -> Outcome {
        let index = self.0;
        self.0 += 1;
        check(value).map_err(|flaw| flaw.inside(Step::Index(index)))
    }
}

fn number(value: f64) -> Outcome {
    if value.is_finite() {
        return Ok(());
    }
    Err(NonFinite::new(value))
}

macro_rules! always_fine {
    ($($method:ident: $type:ty),*) => {$(
        fn $method(self, _: $type) -> Outcome {
            Ok(())
        }
    )*};
}

impl Serializer for Walk {
    type Ok = ();
    type Error = NonFinite;
    type SerializeSeq = Elements;
    type SerializeTuple = Elements;
    type SerializeTupleStruct = Elements;
    type SerializeTupleVariant = Elements;
    type SerializeMap = Elements;
    type SerializeStruct = Fields;
    type SerializeStructVariant = Fields;

    fn serialize_f32(self, value: f32) -> Outcome {
        number(value.into())
    }

    fn serialize_f64(self, value: f64) -> Outcome {
        number(value)
    }

    always_fine!(
        serialize_bool: bool, serialize_char: char, serialize_str: &str, serialize_bytes: &[u8],
        serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64,
        serialize_unit_struct: &'static str
    );

    fn serialize_unit(self) -> Outcome {
        Ok(())
    }

    fn serialize_none(self) -> Outcome {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, _: &'static str) -> Outcome {
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Outcome {
        check(value)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Outcome {
        check(value)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Outcome {
        check(value).map_err(|flaw| flaw.inside(Step::Field(variant)))
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Elements, NonFinite> {
        Ok(Elements(0))
    }

    fn serialize_tuple(self, _: usize) -> Result<Elements, NonFinite> {
        Ok(Elements(0))
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Elements, NonFinite> {
        Ok(Elements(0))
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Elements, NonFinite> {
        Ok(Elements(0))
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Elements, NonFinite> {
        Ok(Elements(0))
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Fields, NonFinite> {
        Ok(Fields)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Fields, NonFinite> {
        Ok(Fields)
    }
}

macro_rules! visit_elements {
    ($($trait:ident::$method:ident),*) => {$(
        impl ser::$trait for Elements {
            type Ok = ();
            type Error = NonFinite;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Outcome {
                self.visit(value)
            }

            fn end(self) -> Outcome {
                Ok(())
            }
        }
    )*};
}

visit_elements!(
    SerializeSeq::serialize_element,
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field
);

impl ser::SerializeMap for Elements {
    type Ok = ();
    type Error = NonFinite;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, _: &T) -> Outcome {
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Outcome {
        self.visit(value)
    }

    fn end(self) -> Outcome {
        Ok(())
    }
}

macro_rules! visit_fields {
    ($($trait:ident),*) => {$(
        impl ser::$trait for Fields {
            type Ok = ();
            type Error = NonFinite;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Outcome {
                check(value).map_err(|flaw| flaw.inside(Step::Field(name)))
            }

            fn end(self) -> Outcome {
                Ok(())
            }
        }
    )*};
}

visit_fields!(SerializeStruct, SerializeStructVariant);

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(Serialize)]
    enum Sample {
        Newtype(Vec<Option<f64>>),
        Tuple(u8, f32),
        Struct { at: [f64; 2] },
        Unit,
    }

    #[derive(Serialize)]
    struct Pair(f64, f64);

    fn problem<T: Serialize>(value: T) -> String {
        check(&value).unwrap_err().to_string()
    }

    #[test]
    fn names_the_first_number_that_is_not_finite() {
        let (nan, inf) = (f64::NAN, f64::INFINITY);
        assert_eq!(
            problem(Sample::Newtype(vec![None, Some(nan)])),
            "Newtype[1] is NaN"
        );
        assert_eq!(problem(Sample::Tuple(1, f32::NEG_INFINITY)), "[1] is -inf");
        assert_eq!(problem(Sample::Struct { at: [0.0, inf] }), "at[1] is inf");
        assert_eq!(
            problem(vec![Pair(0.0, 0.0), Pair(inf, nan)]),
            "[1][0] is inf"
        );
        assert_eq!(
            problem(BTreeMap::from([("a", 1.0), ("b", nan)])),
            "[1] is NaN"
        );
    }

    #[test]
    fn lets_everything_finite_pass() {
        check(&(f64::MAX, f64::MIN_POSITIVE / 3.0, -0.0, f32::MIN)).unwrap();
        check(&(Sample::Unit, None::<f64>, "NaN", u64::MAX, ())).unwrap();
        check(&Sample::Struct { at: [1.0, 2.0] }).unwrap();
    }
}
