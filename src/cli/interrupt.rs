//! What a signal that asks for the end leaves behind: nothing.

/// On SIGINT, SIGTERM and SIGHUP from here on: removes what is half-written, then ends as the signal would have ended
/// the program, which shells report as 130, 143 and 129. A signal that the caller ignores, as `nohup` does SIGHUP,
/// stays ignored.
#[cfg(unix)]
pub(super) fn clean_up_on_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::{iterator::Signals, low_level::emulate_default_handler};

    let ignored = ignored_signals();
    let heeded = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // Where signals cannot be caught, they end the program as ever.
    let Ok(mut signals) = Signals::new(heeded) else { return };
    let wait = move || {
        for signal in &mut signals {
            crate::io::atomic::abandon();
            emulate_default_handler(signal).ok();
        }
    };
    std::thread::Builder::new().name("signals".to_owned()).stack_size(1 << 18).spawn(wait).ok();
}

/// Where there are no signals, there is nothing to heed.
#[cfg(not(unix))]
pub(super) const fn clean_up_on_signals() {}

/// The signals that the process was started to ignore, signal n as bit n - 1; none where the system does not say.
#[cfg(unix)]
fn ignored_signals() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
