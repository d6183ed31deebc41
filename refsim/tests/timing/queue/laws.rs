//! Properties of every list of commands.

use proptest::collection::vec;
use proptest::prelude::*;
use refsim::timing::Picoseconds;
use refsim::timing::queue::{QueueFigures, ReadBackMode};
use refsim::timing::timeline::{SpanKind, Timeline, Unit};

use super::{Command, play};

fn time() -> impl Strategy<Value = u64> {
    prop_oneof![Just(0), 1..20_u64, 1..1000_u64]
}

fn command() -> impl Strategy<Value = Command> {
    let some = || vec(0..4_u64, 0..3);
    prop_oneof![
        2 => time().prop_map(Command::Host),
        3 => (0..4_u64, time()).prop_map(|(resource, time)| Command::Upload(resource, time)),
        1 => time().prop_map(Command::State),
        1 => (0..4_u64, time()).prop_map(|(resource, time)| Command::Clear(resource, time)),
        6 => (some(), some(), [time(), time(), time(), time()])
            .prop_map(|(reads, writes, cost)| Command::Draw { reads, writes, cost }),
        3 => (0..4_u64, time()).prop_map(|(resource, time)| Command::ReadBack(resource, time)),
        1 => Just(Command::Finish),
    ]
}

fn program() -> impl Strategy<Value = Vec<Command>> {
    vec(command(), 0..40)
}

fn mode() -> impl Strategy<Value = ReadBackMode> {
    prop_oneof![Just(ReadBackMode::Synchronous), Just(ReadBackMode::Asynchronous)]
}

fn figures() -> impl Strategy<Value = QueueFigures> {
    let submit = || 0..30_u64;
    (submit(), submit(), submit(), 1..8_u64, 0..4_u64).prop_map(|(a, b, c, commands, draws_ahead)| QueueFigures {
        upload_ps: a,
        state_ps: b,
        constant_ps: b / 2,
        clear_ps: c,
        draw_ps: a,
        read_back_ps: b,
        finish_fence_ps: b,
        commands,
        draws_ahead,
    })
}

fn makespan(commands: &[Command], figures: QueueFigures, mode: ReadBackMode) -> Picoseconds {
    play(commands, figures, mode).makespan()
}

/// Spans and waits of a unit as intervals, sorted by time.
fn intervals(timeline: &Timeline, unit: Unit) -> Vec<(u64, u64)> {
    let spans = timeline.spans().iter().filter(|span| span.unit == unit).map(|span| (span.start.0, span.end.0));
    let waits = timeline.waits().iter().filter(|wait| wait.unit == unit).map(|wait| (wait.start.0, wait.end.0));
    let mut all: Vec<_> = spans.chain(waits).collect();
    all.sort_unstable();
    all
}

/// For each command index of the spans, the resources that the command reads and writes.
fn uses(commands: &[Command], mode: ReadBackMode) -> Vec<(Vec<u64>, Vec<u64>)> {
    let mut fence = false;
    let mut uses = Vec::new();
    for command in commands {
        match command {
            Command::Upload(resource, _) | Command::Clear(resource, _) => uses.push((vec![], vec![*resource])),
            Command::ReadBack(resource, _) => {
                fence |= mode == ReadBackMode::Asynchronous;
                uses.push((vec![*resource], vec![]));
            }
            Command::Draw { reads, writes, .. } => uses.push((reads.clone(), writes.clone())),
            // Without a fence there is nothing to wait for.
            Command::Finish if !fence => {}
            _ => uses.push((vec![], vec![])),
        }
    }
    uses
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    /// A unit does one thing at a time, nothing starts before its cause has ended, and each unit's times and the
    /// critical path add up to the whole run.
    #[test]
    fn every_timeline_is_consistent(commands in program(), figures in figures(), mode in mode()) {
        let timeline = play(&commands, figures, mode);
        let whole = timeline.makespan();
        for unit in Unit::ALL {
            let intervals = intervals(&timeline, unit);
            prop_assert!(intervals.iter().all(|(start, end)| start < end && *end <= whole.0), "{unit}: {intervals:?}");
            prop_assert!(intervals.windows(2).all(|pair| pair[0].1 <= pair[1].0), "{unit}: {intervals:?}");
        }
        for (place, span) in timeline.spans().iter().enumerate() {
            let cause = span.after.map(|id| (id.0 as usize, timeline.span(id).expect("a cause is a span").end));
            prop_assert!(cause.is_none_or(|(id, _)| id < place), "a cause comes first");
            prop_assert_eq!(span.start, cause.map_or(Picoseconds::ZERO, |(_, end)| end) + span.latency);
        }
        let mut now = Picoseconds::ZERO;
        for segment in timeline.critical_path() {
            prop_assert_eq!(segment.start, now);
            now = segment.end;
            let span = segment.span.and_then(|id| timeline.span(id));
            prop_assert!(segment.kind == SpanKind::Fill || span.is_some_and(|span| span.kind == segment.kind));
        }
        prop_assert_eq!(now, whole);
        prop_assert_eq!(timeline.where_the_time_went().iter().map(|share| share.time).sum::<Picoseconds>(), whole);
        for usage in timeline.usage() {
            prop_assert!(usage.busy <= whole);
            prop_assert_eq!(usage.busy + usage.waiting + usage.idle, whole);
            prop_assert_eq!(usage.reasons.iter().map(|(_, time)| *time).sum::<Picoseconds>(), usage.waiting);
        }
        prop_assert_eq!(timeline, play(&commands, figures, mode));
    }

    /// Excludes the host's cost of waiting for a fence, which a synchronous program does not have.
    #[test]
    fn asynchronous_is_never_slower(commands in program(), figures in figures()) {
        let figures = QueueFigures { finish_fence_ps: 0, ..figures };
        let synchronous = makespan(&commands, figures, ReadBackMode::Synchronous);
        prop_assert!(makespan(&commands, figures, ReadBackMode::Asynchronous) <= synchronous);
    }

    #[test]
    fn an_infinitely_fast_card_is_never_slower(commands in program(), figures in figures(), mode in mode()) {
        let fast: Vec<Command> = commands.iter().map(Command::on_infinitely_fast_card).collect();
        prop_assert!(makespan(&fast, figures, mode) <= makespan(&commands, figures, mode));
    }

    #[test]
    fn a_longer_queue_or_more_draws_ahead_are_never_slower(
        commands in program(), figures in figures(), mode in mode()
    ) {
        let roomy = QueueFigures { commands: figures.commands + 1, ..figures };
        let ahead = QueueFigures { draws_ahead: figures.draws_ahead + 1, ..figures };
        let narrow = makespan(&commands, figures, mode);
        prop_assert!(makespan(&commands, roomy, mode) <= narrow);
        prop_assert!(makespan(&commands, ahead, mode) <= narrow);
    }

    #[test]
    fn a_resource_of_its_own_for_every_upload_is_never_slower(
        commands in program(), figures in figures(), mode in mode()
    ) {
        // Resources from 100 on are not used elsewhere, so these uploads neither wait nor block.
        let mut next = 100;
        let renamed: Vec<Command> = commands
            .iter()
            .map(|command| match command {
                Command::Upload(_, time) => {
                    next += 1;
                    Command::Upload(next, *time)
                }
                other => other.clone(),
            })
            .collect();
        prop_assert!(makespan(&renamed, figures, mode) <= makespan(&commands, figures, mode));
    }

    #[test]
    fn all_durations_scale_together(commands in program(), figures in figures(), mode in mode(), by in 1..50_u64) {
        let figures = figures.without_overhead();
        let scaled: Vec<Command> = commands.iter().map(|command| command.scaled(by)).collect();
        let once = play(&commands, figures, mode);
        let times = play(&scaled, figures, mode);
        prop_assert_eq!(once.spans().len(), times.spans().len());
        for (one, many) in once.spans().iter().zip(times.spans()) {
            prop_assert_eq!((one.start.0 * by, one.end.0 * by, one.after), (many.start.0, many.end.0, many.after));
        }
        prop_assert_eq!(once.makespan().0 * by, times.makespan().0);
    }

    #[test]
    fn whoever_writes_a_resource_has_it_alone(commands in program(), figures in figures(), mode in mode()) {
        let timeline = play(&commands, figures, mode);
        let uses = uses(&commands, mode);
        let touches = |kind| {
            use SpanKind::{Clear, Fragments, ReadBack, Traffic, Upload};
            matches!(kind, Upload | Clear | Fragments | Traffic | ReadBack)
        };
        let touching: Vec<_> = timeline.spans().iter().filter(|span| touches(span.kind)).collect();
        for (place, first) in touching.iter().enumerate() {
            let (reads, writes) = &uses[first.command as usize];
            for second in touching[place..].iter().filter(|span| span.command > first.command) {
                let (later_reads, later_writes) = &uses[second.command as usize];
                let shared = |a: &[u64], b: &[u64]| a.iter().any(|resource| b.contains(resource));
                if shared(writes, later_reads) || shared(writes, later_writes) || shared(reads, later_writes) {
                    prop_assert!(first.end <= second.start, "{first:?} and {second:?}");
                }
            }
        }
    }

    #[test]
    fn the_host_has_what_it_waits_for(commands in program(), figures in figures()) {
        let timeline = play(&commands, figures, ReadBackMode::Synchronous);
        // Synchronous: the host continues only after its read-back and everything before it.
        let arrivals = timeline.spans().iter().filter(|span| span.kind == SpanKind::ReadBack);
        for arrival in arrivals {
            let next = timeline.spans().iter().find(|s| s.unit == Unit::Host && s.command > arrival.command);
            let before = timeline.spans().iter().filter(|span| span.command <= arrival.command);
            let done = before.map(|span| span.end).max().unwrap_or_default();
            prop_assert!(next.is_none_or(|next| next.start >= done), "{arrival:?} and {next:?}");
        }
    }
}
