use crossbar_ground::card::{attribute, through_half, vertex_streams};

#[test]
fn registers_are_numbered_in_order() {
    let all = [vec![attribute([1.0, 2.0, 3.0], 1.0); 5], vec![[0; 4]; 5]];
    let streams = vertex_streams(&all);
    assert_eq!((streams.vertex_count, streams.instance_count), (5, 1));
    assert_eq!(streams.streams.iter().map(|stream| stream.register).collect::<Vec<_>>(), [0, 1]);
    assert_eq!(streams.streams[0].data[4], [1.0, 2.0, 3.0, 1.0].map(f32::to_bits));
}

#[test]
fn halves_have_eleven_bits() {
    assert_eq!(through_half(1.0 / 3.0), 0.333_251_95);
    assert_eq!([0.0, 1.5, -2048.0].map(through_half), [0.0, 1.5, -2048.0]);
    assert_eq!(through_half(1e6), f32::INFINITY);
}
