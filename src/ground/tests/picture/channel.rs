use crossbar_ground::picture::metrics::{WorstSample, channels};
use crossbar_ground::picture::{ChannelUnit, Picture, Samples};

fn floats(name: &str, samples: &[f32]) -> Picture {
    let samples = Samples::Float(samples.to_vec());
    Picture::new(2, 2).with(name, ChannelUnit::Unknown, samples).expect("four samples")
}

#[test]
fn figures_of_a_difference_that_is_known() {
    let (left, right) = (floats("Y", &[0.0, 1.0, 2.0, 3.0]), floats("Y", &[-0.0, 1.5, 2.0, 1.0]));
    let [found] = &channels(&left, &right, &[]).expect("one channel")[..] else { panic!("one channel") };
    assert_eq!((found.differing, found.maximum, found.mean), (2, 2.0, -0.375));
    assert_eq!(found.rmse, (4.25_f64 / 4.0).sqrt());
    assert_eq!(found.worst, Some(WorstSample { x: 1, y: 1, left: 3.0, right: 1.0 }));
}

#[test]
fn nan_equals_nan_and_differs_from_all_else() {
    let nan = f32::NAN;
    let (left, right) = (floats("t", &[nan, nan, 1.0, f32::INFINITY]), floats("t", &[nan, 1.0, 1.0, f32::INFINITY]));
    let found = &channels(&left, &right, &[]).expect("one channel")[0];
    assert_eq!((found.differing, found.nan, found.not_finite), (1, [2, 1], 1));
    assert_eq!((found.maximum, found.rmse), (f64::INFINITY, 0.0));
    assert_eq!(found.worst.map(|worst| (worst.x, worst.y)), Some((1, 0)));
    assert_eq!(channels(&left, &left, &[]).expect("one channel")[0].differing, 0);
}

#[test]
fn channels_go_by_name_and_have_to_be_the_same() {
    let rgb = Picture::rgb(2, 2, &[[0.5; 3]; 4]);
    let other = floats("Y", &[0.5; 4]);
    let ids = Picture::new(2, 2).with("Y", ChannelUnit::Id, Samples::Uint(vec![1; 4])).expect("four samples");
    for (left, right, names, said) in [
        (&rgb, &other, vec![], "expected the same channels in both pictures, found "),
        (&rgb, &rgb, vec!["Z".to_owned()], "expected a channel `Z` in both pictures, found "),
        (&rgb, &Picture::rgb(2, 1, &[]), vec![], "expected two pictures of the same size, found "),
        (&ids, &other, vec![], "expected samples of the same type in channel `Y`, found floats and whole numbers"),
    ] {
        assert!(channels(left, right, &names).is_err_and(|error| error.to_string().starts_with(said)), "{said}");
    }
    assert_eq!(channels(&rgb, &rgb, &["G".to_owned()]).expect("G").len(), 1);
}

#[test]
fn what_is_encoded_for_a_screen_is_decoded_against_linear_light() {
    let encoded = Picture::new(2, 2).with("Y", ChannelUnit::Srgb, Samples::Float(vec![1.0; 4])).expect("samples");
    let linear = Picture::new(2, 2).with("Y", ChannelUnit::Linear, Samples::Float(vec![1.0; 4])).expect("samples");
    assert_eq!(channels(&encoded, &linear, &[]).expect("Y")[0].differing, 0);
}
