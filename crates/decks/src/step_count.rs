//! How many steps a deck takes, by its own rule (`steps.py`) along our history: pairs of steps at
//! most half a sample long, restarted at a twentieth of 1/Omega_n by every touch and lift, grown by
//! half from pair to pair after that, shortened to a fifth of the way to the next. A change within
//! 1/Omega_n of one that counted belongs to it: chatter that short is no longer than a few of these
//! steps. What the deck's error estimate shortens comes on top: our history does not say it.

/// Of 1/Omega_n: the shortest step. Growth from pair to pair. Share of the way to the next event.
const SHORTEST: f64 = 0.05;
const GROWTH: f64 = 1.5;
const SHARE: f64 = 0.2;

/// Steps to `duration` (s) of a history whose contact changes at these times (s), at sampling
/// interval dt (s) and 1/Omega_n = `landing` (s). What Newton's iteration refuses and repeats comes
/// on top.
pub fn deck_steps(changes: &[f64], duration: f64, dt: f64, landing: f64) -> usize {
    let (shortest, longest) = ((SHORTEST * landing).min(0.5 * dt), 0.5 * dt);
    let mut last = f64::NEG_INFINITY;
    let apart = |change: &&f64| {
        let counts = **change - last > landing;
        last = if counts { **change } else { last };
        counts
    };
    let changes: Vec<f64> = changes.iter().filter(apart).copied().collect();
    let mut changes = changes.into_iter().peekable();
    let (mut t, mut allowed, mut pairs) = (0.0, shortest, 0);
    while t < duration {
        let mut met = false;
        while changes.next_if(|change| *change <= t).is_some() {
            met = true;
        }
        if met {
            allowed = shortest;
        }
        let next = changes.peek().copied().unwrap_or(f64::INFINITY);
        // equal pairs to the next sample
        let left = ((t / dt + 1e-6).floor() + 1.0) * dt - t;
        let size = longest.min(allowed).min(SHARE * (next - t)).max(shortest);
        let h = 0.5 * left / (0.5 * left / size - 1e-6).ceil().max(1.0);
        // what the next pair may have follows from the length before it was divided to end at the
        // sample
        allowed = GROWTH * size;
        t += 2.0 * h;
        pairs += 1;
    }
    2 * pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 s at 0.01 s, nothing happens: some ten pairs until steps have grown, then one pair a
    /// sample.
    #[test]
    fn without_events_it_is_a_pair_a_sample() {
        let steps = deck_steps(&[], 1.0, 0.01, 1e-3);
        assert!((200..240).contains(&steps), "{steps}");
    }

    /// Between two events far apart: as many pairs down as a fifth of the way each takes, as many
    /// up as the growth.
    #[test]
    fn an_event_costs_some_fifty_steps() {
        let steps =
            deck_steps(&[0.5], 1.0, 0.01, 1e-3) as i64 - deck_steps(&[], 1.0, 0.01, 1e-3) as i64;
        assert!((20..100).contains(&steps), "{steps}");
    }
}
