use ::exr::meta::MetaData;
use crossbar_ground::picture::{ChannelUnit, Picture, PictureNotes, Samples, exr, exr_with_notes};

#[test]
fn notes_stand_in_the_file() {
    let picture = Picture::rgb(2, 1, &[[0.5; 3]; 2]);
    let world_to_camera = Some(std::array::from_fn(|i| i as f32));
    let notes = PictureNotes { software: "crossbar".into(), comments: "caf\u{e9} \u{2192}".into(), world_to_camera };
    let file = exr_with_notes(&picture, &notes).expect("a file");
    let header = &MetaData::read_from_buffered(file.as_slice(), true).expect("our own EXR").headers[0];
    let own = &header.own_attributes;
    assert_eq!(own.software_name.as_ref().map(ToString::to_string).as_deref(), Some("crossbar"));
    assert_eq!(own.comments.as_ref().map(ToString::to_string).as_deref(), Some("caf\u{e9} \\u{2192}"));
    assert_eq!(own.world_to_camera, world_to_camera);
    assert_eq!(
        Picture::decode(&file).expect("our own EXR"),
        Picture::decode(&exr(&picture).expect("a file")).expect("EXR")
    );
}

#[test]
fn a_short_channel_is_an_error() {
    assert!(Picture::new(2, 2).with("t", ChannelUnit::RayLength, Samples::Float(vec![0.0; 3])).is_err());
    assert!(exr(&Picture::new(2, 2)).is_err(), "and so is none at all");
}
