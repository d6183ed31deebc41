//! Values of options.

use clap::builder::TypedValueParser as _;
use clap::error::ErrorKind;
use clap::{Arg, Command};
use crossbar_studies::options::Size;
use crossbar_studies::options::number::{finite, not_negative, point, positive, share};
use crossbar_studies::options::one_of::{OneOf, one_of, variants};

#[test]
fn what_is_wrong_is_said() {
    let large = "expected a number that is not too large for a 32-bit float: at most 3.4028235e38, found `1e39`";
    assert_eq!(point("0,1e39,0").unwrap_err(), large);
    assert_eq!(point("0,1").unwrap_err(), "expected three numbers X,Y,Z, found `0,1`");
    assert_eq!(point("0,x,1").unwrap_err(), "expected a number, found `x`");
    assert_eq!(not_negative("-1").unwrap_err(), "expected a number not below 0, found `-1`");
    assert_eq!(share("1").unwrap_err(), "expected a number above 0 and below 1, found `1`");
    assert_eq!(positive("nan").unwrap_err(), "expected a finite number, found `nan`");
    let beyond = "expected a number that is not too large for a 64-bit float, found `1e400`";
    assert_eq!(finite("1e400").unwrap_err(), beyond);
}

#[test]
fn sizes() {
    assert_eq!("640x480".parse(), Ok(Size { width: 640, height: 480 }));
    assert_eq!("1X1".parse(), Ok(Size { width: 1, height: 1 }));
    for text in ["", "640", "640x", "x480", "0x5", "5x0", "640x480x3", "-1x5", "+1x5", "640 x 480", "16385x1"] {
        assert!(text.parse::<Size>().is_err(), "`{text}`");
    }
}

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
    let parser = variants::<Count>();
    let values = parser.possible_values().into_iter().flatten();
    let help: Vec<String> = values.filter_map(|value| value.get_help().map(ToString::to_string)).collect();
    assert_eq!(help, ["A texel alone", "All of 2.5"]);
}
