use ::exr::meta::MetaData;
use crossbar_ground::picture::{ChannelUnit, Picture, PictureNotes, Samples, exr, exr_with_notes};

#[test]
fn floats_and_ids_come_back_to_the_bit() {
    let t = vec![0.1_f32, f32::NAN, f32::INFINITY, -0.0, 1e-40, 3.0];
    let id = vec![0, 1, u32::MAX, 4, 5, 6];
    let picture = Picture::new(3, 2)
        .with("t", ChannelUnit::RayLength, Samples::Float(t.clone()))
        .and_then(|picture| picture.with("id", ChannelUnit::Id, Samples::Uint(id.clone())))
        .expect("six samples each");
    let back = Picture::decode(&exr(&picture).expect("a file")).expect("our own EXR");
    let bits = |samples: &[f32]| samples.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(back.floats("t").expect("floats").1), bits(&t));
    let ids = back.channels().iter().find(|channel| channel.name == "id").expect("ids");
    assert_eq!(ids.samples, Samples::Uint(id));
}

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
