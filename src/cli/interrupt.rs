//! Termination by a signal: only a message is left.

#[cfg(unix)]
use super::{Problem, error};

/// Maximum time that the program waits for someone to read its last message.
#[cfg(unix)]
const LAST_WORDS: std::time::Duration = std::time::Duration::from_millis(500);

/// From now on, SIGINT, SIGTERM and SIGHUP remove incomplete files, report that the work is lost, and end the program
/// as the signal would have: shells report 130, 143 and 129. A signal that the caller ignores, as `nohup` ignores
/// SIGHUP, stays ignored.
#[cfg(unix)]
pub(super) fn clean_up_on_signals(json: bool) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::{iterator::Signals, low_level::emulate_default_handler};

    let ignored = ignored_signals();
    let heeded = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // If signals cannot be caught, they end the program by default.
    let Ok(mut signals) = Signals::new(heeded) else { return };
    let wait = move || {
        for signal in &mut signals {
            if crate::io::atomic::abandon() {
                say_what_is_lost(json);
            }
            emulate_default_handler(signal).ok();
        }
    };
    std::thread::Builder::new().name("signals".to_owned()).stack_size(1 << 18).spawn(wait).ok();
}

/// Reports that nothing was written, without waiting for a full pipe.
#[cfg(unix)]
fn say_what_is_lost(json: bool) {
    let (said, heard) = std::sync::mpsc::channel();
    let say = move || {
        error::print(Problem::Interrupted.into(), json);
        said.send(()).ok();
    };
    if std::thread::Builder::new().name("last words".to_owned()).spawn(say).is_ok() {
        heard.recv_timeout(LAST_WORDS).ok();
    }
}

/// On systems without signals, there is nothing to handle.
#[cfg(not(unix))]
pub(super) const fn clean_up_on_signals(_json: bool) {}

/// Signals that the process inherited as ignored: bit n - 1 for signal n; 0 if the system does not report them.
#[cfg(unix)]
fn ignored_signals() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
