//! The error of all studies.

use std::error::Error as _;
use std::fmt;

use crossbar_base::error::InputError;
use crossbar_studies::study::StudyError;
use miette::Diagnostic as _;
use refsim::device::DeviceError;

/// Errors of libraries are forwarded as thiserror's derives forward them: with `#[error(transparent)]` and a code, or
/// transparent altogether. An error with the study's own sentence has its cause in the chain.
#[test]
fn errors_are_forwarded_as_by_the_derives() {
    let text = |shown: Option<Box<dyn fmt::Display + '_>>| shown.map(|shown| shown.to_string());
    let unknown = || refsim::device::Profile::named("nv99").expect_err("there is none");
    let as_it_is = StudyError::from(unknown());
    assert_eq!(as_it_is.to_string(), unknown().to_string());
    assert_eq!(text(as_it_is.code()), text(unknown().code()));
    assert_eq!(text(as_it_is.help()), text(unknown().help()));
    assert!(as_it_is.downcast_ref::<DeviceError>().is_some());

    let coded = StudyError::coded("room::step", unknown());
    assert_eq!(coded.to_string(), unknown().to_string());
    assert_eq!([text(coded.code()), text(coded.help())], [Some("room::step".to_owned()), None]);
    assert!(coded.source().is_none(), "the error displayed is not in its own chain");
    assert!(coded.downcast_ref::<InputError>().is_none());

    let own = StudyError::new("room::file", "cannot use x").with_help("name y").with_source(unknown());
    assert_eq!(own.to_string(), "cannot use x");
    assert_eq!([text(own.code()), text(own.help())], ["room::file", "name y"].map(|s| Some(s.to_owned())));
    assert_eq!(own.source().map(ToString::to_string), Some(unknown().to_string()));
}
