//! Numbers and constants of case files.

use std::path::Path;

use crossbar_studies::case::Setup;

/// The first component of `c0` as an IEEE single, in a case that defines it by `text`.
fn single(text: &str) -> Result<u32, String> {
    let case = format!(
        "device = \"ideal-fp32\"\n[pixel]\nsource = \"ps_2_0\\nmov oC0, c0\"\n[constants]\nc0 = [{text}, 0, 0, 0]\n\
         [geometry]\nfull_screen = true\n[target]\nsize = [1, 1]\nformat = \"rgba32f\"\n"
    );
    let setup = Setup::from_bytes("case.toml", case.as_bytes(), Path::new("")).map_err(|error| error.to_string())?;
    Ok(setup.pixel_constants.float[0][0])
}

#[test]
fn numbers_become_singles() {
    for (text, bits) in [
        ("1", 0x3f80_0000),
        ("-0.0", 0x8000_0000),
        ("0.1", 0x3dcc_cccd),
        ("1e300", 0x7f80_0000),
        ("-inf", 0xff80_0000),
        ("-nan", 0x7fc0_0000),
        ("\"0xffc12345\"", 0xffc1_2345),
    ] {
        assert_eq!(single(text), Ok(bits), "{text}");
    }
}

#[test]
fn other_texts_are_errors() {
    for text in ["\"1.0\"", "\"0x\"", "\"0x123456789\"", "\"0x+1\"", "true", "[1]"] {
        let message = single(text).expect_err("no number");
        assert!(message.contains("0x3f800000"), "{text}: the message says what is wanted: {message}");
    }
}

/// A case may set the registers that the checker lets a program read on the device; ideal devices have more.
#[test]
fn constants_are_those_of_version_and_device() {
    let outcome = |device: &str, program: &str, constant: &str| {
        let case = format!(
            "device = \"{device}\"\n[pixel]\nsource = \"{program}\"\n[constants]\n{constant}\n\
             [geometry]\nfull_screen = true\n[target]\nsize = [1, 1]\nformat = \"bgra8\"\n"
        );
        Setup::from_bytes("case.toml", case.as_bytes(), Path::new("")).map(|_| ()).map_err(|error| error.to_string())
    };
    let (old, new) = ("ps_1_4\\nmov r0, c0", "ps_2_0\\nmov r0, c0\\nmov oC0, r0");
    for (device, program, constant, expected) in [
        ("r200", old, "c7 = [0, 0, 0, 0]", None),
        ("r200", old, "c8 = [0, 0, 0, 0]", Some("c0 to c7")),
        ("r300", old, "c8 = [0, 0, 0, 0]", Some("c0 to c7")),
        ("ideal-s3.12", old, "c8 = [0, 0, 0, 0]", None),
        ("r200", old, "b0 = true", Some("c0 to c7")),
        ("r300", new, "c31 = [0, 0, 0, 0]", None),
        ("r300", new, "c32 = [0, 0, 0, 0]", Some("c0 to c31, i0 to i15, b0 to b15")),
        ("r300", new, "b15 = true", None),
    ] {
        let name = constant.split(' ').next().unwrap_or_default();
        match (outcome(device, program, constant), expected) {
            (Ok(()), None) => {}
            (Err(found), Some(known)) => {
                let wanted = format!("expected a constant {known}, found `{name}`");
                assert!(found.contains(&wanted), "{device}: {found}, not {wanted}");
            }
            (found, _) => panic!("{device}: {constant}: {found:?}, not {expected:?}"),
        }
    }
}
