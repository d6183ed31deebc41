use crossbar_ground::io::{NumberError, parse_f32, parse_f64, to_f32};

#[test]
fn each_fault_has_its_name() {
    assert_eq!(parse_f32("3.4028235e38"), Ok(f32::MAX));
    assert_eq!(parse_f32("-1e-50"), Ok(-0.0));
    for (text, fault) in [
        ("five", NumberError::NoNumber),
        ("", NumberError::NoNumber),
        ("nan", NumberError::NotFinite),
        ("-inf", NumberError::NotFinite),
        ("infinity", NumberError::NotFinite),
        ("1e39", NumberError::TooLarge),
        ("-3.4028236e38", NumberError::TooLarge),
    ] {
        assert_eq!(parse_f32(text), Err(fault), "{text}");
    }
    assert_eq!((parse_f64("1e39"), parse_f64("1e-320")), (Ok(1e39), Ok(1e-320)));
    assert_eq!(parse_f64("1e400"), Err(NumberError::TooLargeForDouble));
    assert_eq!((parse_f64("x"), parse_f64("nan")), (Err(NumberError::NoNumber), Err(NumberError::NotFinite)));
    assert_eq!((to_f32(1e39), to_f32(f64::INFINITY)), (Err(NumberError::TooLarge), Ok(f32::INFINITY)));
}
