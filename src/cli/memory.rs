//! Work that would not fit into memory is refused before it begins.
//!
//! A command says what it needs at most, counted from the sizes that it is asked for. What there is: the memory that
//! the system can give without swapping, what the process's control group still allows, and what `ulimit -v` still
//! allows; the least of the three, or what `--memory-limit` says instead.

use std::fmt;
use std::sync::OnceLock;
use std::thread::available_parallelism;

use bytesize::ByteSize;
use miette::Diagnostic;
use sysinfo::{Pid, ProcessRefreshKind, ProcessesToUpdate, System};

/// The value of `--memory-limit`; not set without the option.
static ASKED: OnceLock<u64> = OnceLock::new();

/// Memory of the program itself: code, tables, buffers of files, and work so small that nobody asks whether it fits
/// ([`SMALL`]), of which a scene with its tree and a picture may be several pieces at a time.
const PROGRAM: u64 = 72 << 20;
/// Address space of a thread, which `ulimit -v` counts whether it is used or not: its stack, and the arena that glibc
/// reserves for each thread that allocates.
const THREAD: u64 = if cfg!(target_env = "gnu") { 66 << 20 } else { 2 << 20 };
/// The thread that waits for signals.
const HELPERS: u64 = 1;
/// The address space that was taken when the program began, and how many threads work.
static START: OnceLock<(u64, u64)> = OnceLock::new();
/// Needs below this are not worth asking the system.
const SMALL: u64 = 16 << 20;

/// Where a limit comes from.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
pub enum LimitSource {
    /// `--memory-limit`.
    #[strum(to_string = "allowed by `--memory-limit`")]
    Option,
    /// The system's free memory.
    #[strum(to_string = "free on this computer")]
    System,
    /// The rest of the limit of the control group, a container for example.
    #[strum(to_string = "left to this control group or container")]
    ControlGroup,
    /// The rest of the limit of the process's addresses.
    #[strum(to_string = "left to this process by `ulimit -v`")]
    Process,
}

/// Work that needs more memory than there is.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("{what} takes up to {need} of memory, but {limit} are {from}")]
#[diagnostic(code(crossbar::memory), help("{help}"))]
pub struct MemoryError {
    /// The work.
    pub what: String,
    /// Upper bound of its memory.
    pub need: ByteSize,
    /// The limit.
    pub limit: ByteSize,
    /// Source of the limit.
    pub from: LimitSource,
    /// How to ask for less.
    pub help: String,
}

/// Upper bound of a command's memory.
#[derive(Clone, Debug)]
pub(super) struct MemoryNeed {
    /// The work, as in "tracing 512x512 pixels".
    pub(super) what: String,
    /// Bytes.
    pub(super) bytes: u64,
    /// How to ask for less.
    pub(super) help: &'static str,
}

impl MemoryNeed {
    /// Refuses work that needs more memory than there is.
    ///
    /// # Errors
    /// [`MemoryError`].
    pub(super) fn require(&self) -> Result<(), MemoryError> {
        require(&self.what, self.bytes, self.help)
    }
}

/// Sets the limit that `--memory-limit` asks for.
pub(super) fn limit_to(bytes: Option<ByteSize>) {
    if let Some(bytes) = bytes {
        // Set once, by `main`.
        ASKED.set(bytes.as_u64()).ok();
    }
}

/// Refuses work that needs more `bytes` than there are. `what` is the work, as in "tracing 512x512 pixels"; `help` how
/// to ask for less.
///
/// # Errors
/// [`MemoryError`].
pub(super) fn require(what: impl fmt::Display, bytes: u64, help: &str) -> Result<(), MemoryError> {
    if bytes < SMALL && ASKED.get().is_none() {
        return Ok(());
    }
    let (limit, from) = limit();
    if bytes <= limit {
        return Ok(());
    }
    let help = match from {
        LimitSource::Option => help.to_owned(),
        _ => format!("{help}; `--memory-limit` says how much may be taken instead"),
    };
    Err(MemoryError { what: what.to_string(), need: ByteSize(bytes), limit: ByteSize(limit), from, help })
}

/// How many threads are to work, where `asked` is what `--threads` says: one per core, but no more than leave half of
/// the address space to the work. 0 stands for as many as rayon takes by itself.
///
/// # Errors
/// [`MemoryError`] where not even the program and its threads fit.
pub(super) fn threads_to_start(asked: Option<u16>) -> Result<usize, MemoryError> {
    let usual = available_parallelism().map_or(1, |cores| cores.get() as u64);
    let (limit, taken) = (address_space().unwrap_or(u64::MAX), address_space_taken());
    let room = limit.saturating_sub(taken + PROGRAM + HELPERS * THREAD);
    let threads = asked.map_or_else(|| usual.min(room / 2 / THREAD).max(1), u64::from);
    START.set((taken, threads)).ok();
    let need = taken + PROGRAM + (threads + HELPERS) * THREAD;
    if need <= limit {
        return Ok(if asked.is_none() && threads == usual { 0 } else { threads as usize });
    }
    let (need, limit) = (ByteSize(need), ByteSize(limit));
    let help = if asked > Some(1) { "raise `ulimit -v`, or lower `--threads`" } else { "raise `ulimit -v`" };
    let what = format!("the program itself with {threads} {}", if threads == 1 { "thread" } else { "threads" });
    Err(MemoryError { what, need, limit, from: LimitSource::Process, help: help.to_owned() })
}

fn limit() -> (u64, LimitSource) {
    if let Some(&asked) = ASKED.get() {
        return (asked, LimitSource::Option);
    }
    let mut limits = vec![(u64::MAX, LimitSource::System)];
    if let Ok(mut system) = System::new() {
        system.refresh_memory();
        if system.available_memory() > 0 {
            limits.push((system.available_memory(), LimitSource::System));
        }
        let own = Pid::from_u32(std::process::id());
        system.refresh_processes_specifics(ProcessesToUpdate::Some(&[own]), false, ProcessRefreshKind::nothing());
        let group = system.process(own).and_then(|process| process.cgroup_limits()).or_else(|| system.cgroup_limits());
        if let Some(group) = group {
            // Pages of files that the group has read do not count: they make way.
            limits.push((group.total_memory.saturating_sub(group.rss), LimitSource::ControlGroup));
        }
    }
    limits.extend(process_limit().map(|limit| (limit, LimitSource::Process)));
    limits.into_iter().min_by_key(|limit| limit.0).unwrap_or((u64::MAX, LimitSource::System))
}

/// The rest of the limit of the process's addresses after those of all threads; `None` without a limit.
fn process_limit() -> Option<u64> {
    let (start, threads) = START.get().copied().unwrap_or_default();
    let taken = address_space_taken().max(start + (threads + HELPERS) * THREAD);
    Some(address_space()?.saturating_sub(taken))
}

/// The addresses that the process may take, as `ulimit -v` says; `None` without a limit.
#[cfg(unix)]
fn address_space() -> Option<u64> {
    rustix::process::getrlimit(rustix::process::Resource::As).current
}

#[cfg(not(unix))]
const fn address_space() -> Option<u64> {
    None
}

/// The addresses that the process has taken; 0 where the system does not say.
#[cfg(unix)]
fn address_space_taken() -> u64 {
    let taken = std::fs::read_to_string("/proc/self/statm").ok();
    let pages: u64 = taken.and_then(|text| text.split_whitespace().next()?.parse().ok()).unwrap_or(0);
    pages * rustix::param::page_size() as u64
}

#[cfg(not(unix))]
const fn address_space_taken() -> u64 {
    0
}

/// The value of `--memory-limit`.
pub(super) fn byte_size(text: &str) -> Result<ByteSize, String> {
    text.parse().map_err(|_| format!("expected a number of bytes as in 4GiB, 500MB or 1000000, found `{text}`"))
}

/// `per_pixel` bytes for each pixel of a picture, and `fixed` bytes.
pub(super) const fn of_pixels(width: u32, height: u32, per_pixel: u64, fixed: u64) -> u64 {
    (width as u64 * height as u64).saturating_mul(per_pixel).saturating_add(fixed)
}
