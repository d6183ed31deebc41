//! Small programs with manually derived timelines.

use refsim::timing::queue::{Queue, QueueFigures, ReadBackMode, ResourceCopy, ResourceId};
use refsim::timing::timeline::{SpanKind, Unit, WaitReason};
use refsim::timing::{DrawCost, Picoseconds};

use super::{cost, free, spans};

const RAYS: ResourceCopy = ResourceCopy { resource: ResourceId::Texture(0), second: false };
const IDS: ResourceCopy = ResourceCopy { resource: ResourceId::Texture(1), second: false };

fn ps(time: u64) -> Picoseconds {
    Picoseconds(time)
}

#[test]
fn one_pass_is_upload_then_fragments_then_read_back() {
    let mut queue = Queue::new(free());
    queue.upload(RAYS, ps(10), "rays");
    queue.draw(&[RAYS], &[IDS], cost(2, 8, 5, 3), "triangles");
    queue.read_back(IDS, ps(4), ReadBackMode::Synchronous, "ids");
    let timeline = queue.timeline();
    assert_eq!(spans(&timeline, Unit::UploadBus), [(0, 10)]);
    // Vertices don't need the rays; fragments do.
    assert_eq!(spans(&timeline, Unit::FrontEnd), [(0, 2)]);
    assert_eq!(spans(&timeline, Unit::ShaderArray), [(10, 18)]);
    assert_eq!(spans(&timeline, Unit::Memory), [(10, 15)]);
    assert_eq!(spans(&timeline, Unit::ReadBackBus), [(18, 22)]);
    assert_eq!(timeline.makespan(), ps(22));

    let path: Vec<_> = timeline.critical_path().iter().map(|s| (s.kind, s.start.0, s.end.0)).collect();
    assert_eq!(path, [(SpanKind::Upload, 0, 10), (SpanKind::Fragments, 10, 18), (SpanKind::ReadBack, 18, 22)]);
    let usage = timeline.usage();
    let of = |unit: Unit| &usage[unit.index()];
    assert_eq!((of(Unit::Host).busy, of(Unit::Host).waiting, of(Unit::Host).idle), (ps(0), ps(22), ps(0)));
    assert_eq!(of(Unit::Host).reasons, [(WaitReason::Transfer, ps(22))]);
    let shader = of(Unit::ShaderArray);
    assert_eq!((shader.busy, shader.waiting, shader.idle), (ps(8), ps(10), ps(4)));
    assert_eq!(shader.reasons, [(WaitReason::Hazard, ps(10))]);
    assert_eq!((of(Unit::FrontEnd).busy, of(Unit::FrontEnd).idle), (ps(2), ps(20)));
}

#[test]
fn vertices_of_the_next_draw_go_beside_fragments_of_this_one() {
    let mut queue = Queue::new(free());
    queue.draw(&[], &[IDS], cost(4, 10, 6, 5), "first");
    queue.draw(&[], &[IDS], cost(4, 10, 6, 5), "second");
    let timeline = queue.timeline();
    assert_eq!(spans(&timeline, Unit::FrontEnd), [(0, 4), (4, 8)]);
    assert_eq!(spans(&timeline, Unit::ShaderArray), [(5, 15), (15, 25)]);
    assert_eq!(spans(&timeline, Unit::Memory), [(5, 11), (15, 21)]);
    let path: Vec<_> = timeline.critical_path().iter().map(|s| (s.kind, s.end.0)).collect();
    assert_eq!(path, [(SpanKind::Fill, 5), (SpanKind::Fragments, 15), (SpanKind::Fragments, 25)]);
}

#[test]
fn a_draw_alone_takes_its_total() {
    for cost in [cost(4, 10, 6, 5), cost(10, 2, 0, 3), cost(1, 2, 9, 4), cost(0, 0, 0, 7)] {
        let mut queue = Queue::new(free());
        queue.draw(&[], &[IDS], cost, "draw");
        assert_eq!(queue.timeline().makespan(), cost.total, "{cost:?}");
    }
    // A total below the longest unit does not shorten the draw.
    let mut queue = Queue::new(free());
    queue.draw(&[], &[IDS], DrawCost { total: ps(1), ..cost(0, 9, 0, 0) }, "draw");
    assert_eq!(queue.timeline().makespan(), ps(9));
}

#[test]
fn many_vertices_bind_the_front_end() {
    let mut queue = Queue::new(free());
    queue.draw(&[], &[IDS], cost(10, 2, 0, 3), "first");
    queue.draw(&[], &[IDS], cost(10, 2, 0, 3), "second");
    let timeline = queue.timeline();
    assert_eq!(spans(&timeline, Unit::ShaderArray), [(3, 5), (13, 15)]);
    assert_eq!(timeline.makespan(), ps(23));
    let path: Vec<_> = timeline.critical_path().iter().map(|s| (s.kind, s.end.0)).collect();
    assert_eq!(path, [(SpanKind::Vertices, 10), (SpanKind::Vertices, 20), (SpanKind::Fill, 23)]);
}

#[test]
fn the_front_end_runs_so_many_draws_ahead() {
    let starts = |ahead| {
        let mut queue = Queue::new(QueueFigures { draws_ahead: ahead, ..free() });
        for _ in 0..4 {
            queue.draw(&[], &[IDS], cost(1, 10, 0, 1), "draw");
        }
        spans(&queue.timeline(), Unit::FrontEnd).iter().map(|span| span.0).collect::<Vec<_>>()
    };
    assert_eq!(starts(0), [0, 11, 22, 33]);
    assert_eq!(starts(1), [0, 1, 11, 21]);
    assert_eq!(starts(8), [0, 1, 2, 3]);
}

#[test]
fn a_full_queue_stalls_the_host() {
    let mut queue = Queue::new(QueueFigures { commands: 1, draws_ahead: 0, draw_ps: 1, ..free() });
    for _ in 0..3 {
        queue.draw(&[], &[IDS], cost(0, 10, 0, 0), "draw");
    }
    let timeline = queue.timeline();
    assert_eq!(spans(&timeline, Unit::Host), [(0, 1), (1, 2), (11, 12)]);
    assert_eq!(spans(&timeline, Unit::ShaderArray), [(1, 11), (11, 21), (21, 31)]);
    let usage = timeline.usage();
    assert_eq!(usage[Unit::Host.index()].reasons, [(WaitReason::QueueFull, ps(9))]);
    assert_eq!(usage[Unit::Host.index()].idle, ps(19));
}

#[test]
fn an_asynchronous_read_back_has_a_fence() {
    let mut queue = Queue::new(free());
    queue.draw(&[], &[IDS], cost(0, 10, 0, 0), "draw");
    let fence = queue.read_back(IDS, ps(5), ReadBackMode::Asynchronous, "ids").expect("a fence");
    // A draw to another target runs during the transfer; a draw to the same target runs after it.
    queue.draw(&[], &[RAYS], cost(0, 3, 0, 0), "beside");
    queue.draw(&[], &[IDS], cost(0, 3, 0, 0), "after");
    queue.finish(fence);
    assert_eq!(queue.now(), ps(15));
    assert!(queue.read_back(IDS, ps(5), ReadBackMode::Synchronous, "ids").is_none());
    let timeline = queue.timeline();
    assert_eq!(spans(&timeline, Unit::ShaderArray), [(0, 10), (10, 13), (15, 18)]);
    assert_eq!(spans(&timeline, Unit::ReadBackBus), [(10, 15), (18, 23)]);
    let wait = timeline.waits().iter().find(|wait| wait.unit == Unit::Host).expect("the host has waited");
    assert_eq!((wait.start, wait.end, wait.reason), (ps(0), ps(15), WaitReason::Fence));
}

#[test]
fn a_read_back_comes_after_all_draws_before_it() {
    let mut queue = Queue::new(free());
    queue.draw(&[], &[IDS], cost(0, 10, 0, 0), "into what is read back");
    queue.draw(&[], &[RAYS], cost(0, 7, 0, 0), "into something else");
    queue.read_back(IDS, ps(5), ReadBackMode::Asynchronous, "ids");
    assert_eq!(spans(&queue.timeline(), Unit::ReadBackBus), [(17, 22)]);
}

#[test]
fn an_upload_waits_for_draws_that_read_what_it_overwrites() {
    let mut queue = Queue::new(free());
    queue.draw(&[RAYS], &[IDS], cost(0, 10, 0, 0), "draw");
    queue.upload(RAYS, ps(2), "more rays");
    queue.upload(ResourceId::Texture(7).into(), ps(2), "something else");
    let timeline = queue.timeline();
    assert_eq!(spans(&timeline, Unit::UploadBus), [(10, 12), (12, 14)]);
    let wait = timeline.waits()[0];
    assert_eq!((wait.unit, wait.start, wait.end, wait.reason), (Unit::UploadBus, ps(0), ps(10), WaitReason::Hazard));
    assert_eq!(timeline.span(wait.on.expect("a span")).expect("there").label.as_ref(), "draw");
}

#[test]
fn figures_can_be_listed_and_changed_by_name() {
    let mut figures = QueueFigures::default();
    let keys: Vec<String> = figures.rows().into_iter().map(|row| row.key).collect();
    for key in &keys {
        let figure = figures.figure_mut(key).expect("every row can be changed");
        *figure *= 2;
    }
    assert_eq!(figures.draw_ps, 2 * QueueFigures::default().draw_ps);
    assert_eq!(figures.figure_mut("queue.no_such"), None);
    assert_eq!(figures.figure_mut("draw_ps"), None);
}
