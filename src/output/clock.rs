//! Durations as a clock shows them.

use std::time::Duration;

/// `0:05`, `12:34`, `1:02:03`
pub fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_read_like_a_clock() {
        let table = [(0, "0:00"), (65, "1:05"), (3599, "59:59"), (3600, "1:00:00"), (90_061, "25:01:01")];
        for (seconds, words) in table {
            assert_eq!(clock(Duration::from_secs(seconds)), words);
        }
    }
}
