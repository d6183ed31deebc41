//! Options whose values have names: a parser for enums of the library, and for listed values.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command};
use strum::{EnumMessage, IntoEnumIterator};

/// Parser of a value by its name; help and errors match clap's for its own enums.
#[derive(Clone)]
pub struct OneOf<T>(Vec<(PossibleValue, T)>);

/// The variants of an enum by their `strum` names; their help is the first paragraph of their documentation.
pub fn variants<T: IntoEnumIterator + EnumMessage>() -> OneOf<T> {
    let named = |value: T| {
        let name = value.get_serializations().first()?;
        Some((PossibleValue::new(*name).help(summary(value.get_documentation().unwrap_or_default())), value))
    };
    OneOf(T::iter().filter_map(named).collect())
}

/// The name of a variant on the command line.
pub fn name<T: EnumMessage>(value: &T) -> &'static str {
    value.get_serializations().first().copied().unwrap_or_default()
}

/// Values with their names and their help texts.
pub fn one_of<T>(values: impl IntoIterator<Item = (&'static str, &'static str, T)>) -> OneOf<T> {
    OneOf(values.into_iter().map(|(name, help, value)| (PossibleValue::new(name).help(help), value)).collect())
}

/// The first paragraph as one line without its full stop, in the style of clap's help.
fn summary(documentation: &str) -> String {
    let lines = documentation.lines().map(str::trim).take_while(|line| !line.is_empty());
    lines.collect::<Vec<_>>().join(" ").trim_end_matches('.').to_owned()
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for OneOf<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, text: &OsStr) -> Result<T, clap::Error> {
        let names = PossibleValuesParser::new(self.0.iter().map(|(name, _)| name.clone()));
        let text = names.parse_ref(command, arg, text)?;
        let ignore_case = arg.is_some_and(Arg::is_ignore_case_set);
        let found = self.0.iter().find(|(name, _)| name.matches(&text, ignore_case));
        found.map(|(_, value)| value.clone()).ok_or_else(|| clap::Error::new(ErrorKind::InvalidValue).with_cmd(command))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.0.iter().map(|(name, _)| name.clone())))
    }
}
