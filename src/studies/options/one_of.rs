//! Options whose values have names: a parser for the enums of the library, and for values that are listed.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Command};
use strum::{EnumMessage, IntoEnumIterator};

/// Parser of a value by its name; help and errors are those of clap's own enums.
#[derive(Clone)]
pub struct OneOf<T>(Vec<(PossibleValue, T)>);

/// The variants of an enum under the names that `strum` gives them. The help of each is the first paragraph of its
/// documentation.
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

/// Values with their names and the help of each.
pub fn one_of<T>(values: impl IntoIterator<Item = (&'static str, &'static str, T)>) -> OneOf<T> {
    OneOf(values.into_iter().map(|(name, help, value)| (PossibleValue::new(name).help(help), value)).collect())
}

/// The first paragraph as one line, without its full stop, as clap writes help.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A number of texels.
    #[derive(Clone, Copy, Debug, PartialEq, strum::EnumIter, strum::EnumMessage)]
    #[strum(serialize_all = "kebab-case")]
    enum Count {
        /// A texel
        /// alone.
        ///
        /// The paper's.
        OneTexel,
        /// All of 2.5.
        #[strum(to_string = "2")]
        Two,
    }

    fn parsed<T: Clone + Send + Sync + 'static>(parser: OneOf<T>, text: &str) -> Result<T, ErrorKind> {
        let arg = Arg::new("texels").long("texels").ignore_case(true).value_parser(parser);
        let matches = Command::new("test").arg(arg).try_get_matches_from(["test", "--texels", text]);
        let matches = matches.map_err(|error| error.kind())?;
        matches.get_one("texels").cloned().ok_or(ErrorKind::MissingRequiredArgument)
    }

    #[test]
    fn values_are_found_by_their_names_and_no_others() {
        assert_eq!(parsed(variants::<Count>(), "one-texel"), Ok(Count::OneTexel));
        assert_eq!(parsed(variants::<Count>(), "One-Texel"), Ok(Count::OneTexel));
        assert_eq!(parsed(variants::<Count>(), "2"), Ok(Count::Two));
        assert_eq!(parsed(variants::<Count>(), "two"), Err(ErrorKind::InvalidValue));
        assert_eq!(parsed(one_of([("a", "", 1), ("b", "", 2)]), "b"), Ok(2));
        assert_eq!(parsed(one_of([("a", "", 1)]), ""), Err(ErrorKind::InvalidValue));
    }

    #[test]
    fn help_is_the_first_paragraph() {
        let help: Vec<String> = variants::<Count>()
            .possible_values()
            .into_iter()
            .flatten()
            .map(|value| value.get_help().map(ToString::to_string).unwrap_or_default())
            .collect();
        assert_eq!(help, ["A texel alone", "All of 2.5"]);
    }
}
