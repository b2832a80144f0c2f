//! Which corners the ground holds, by trying every set of them.

use nalgebra::DVector;

use super::CornerSet;
use super::hold::{Configuration, CornerContact, HeldMotion};
use super::walk::ON_GROUND;
use crate::Mechanics;
use rocking::scalar::GRAVITY;

/// A corner that a landing leaves with less speed has not been moved (m/s).
pub(crate) const AT_REST: f64 = 1e-8;
/// Speed into the ground, as a share of the landing speed, that is rounding.
const ROUNDING: f64 = 1e-9;
/// Acceleration into the ground that is rounding (m/s2).
const ROUNDING_A: f64 = 1e-9 * GRAVITY;

/// The ground's say on which corners may be let go.
pub(crate) struct Rule<'a> {
    /// Footing of each corner.
    pub footings: &'a [usize],
    /// Whether a footing may leave the ground altogether.
    pub hop: bool,
    /// Vertical force that is rounding (N).
    pub rounding: f64,
}

impl Rule<'_> {
    /// Whether a corner is the only one of its footing in a set and has to stay.
    pub(crate) fn bound(&self, set: CornerSet, i: usize) -> bool {
        !self.hop && !set.without(i).iter().any(|k| self.footings[k] == self.footings[i])
    }

    /// Whether of every footing in a set that has to keep a corner, one is kept.
    fn allows(&self, kept: CornerSet, of: CornerSet) -> bool {
        self.hop || of.iter().all(|i| kept.iter().any(|k| self.footings[k] == self.footings[i]))
    }
}

/// What a landing leaves.
pub(crate) struct Landed {
    /// Velocities.
    pub velocity: DVector<f64>,
    /// Corners that are held.
    pub held: CornerSet,
    /// A corner that slides on, the sign of the force that brakes it, and the energy that stopping
    /// it would have taken (J).
    pub sliding: Option<(usize, f64, f64)>,
}

/// A landing of some corners. `touching`: those held before and those that land.
///
/// A corner that comes in flat may be one that would have to be pulled to stop: the impulse that
/// stops it horizontally would throw it up. It is then stopped vertically only, by the horizontal
/// impulse alone, and slides on: Coulomb's limit of great friction, as in `stay`.
pub(crate) fn land<M: Mechanics>(
    at: &Configuration<M>,
    ground: [f64; 2],
    touching: CornerSet,
    landing: CornerSet,
    rule: &Rule,
) -> Option<Landed> {
    let speed = landing.iter().map(|i| -at.velocity(i, at.v)[1]).fold(0.0, f64::max);
    let good = |kept: CornerSet, after: &HeldMotion| {
        let pushed =
            |i: usize| rule.bound(kept, i) || after.force(i)[1] >= -ROUNDING * largest(after);
        kept.iter().all(pushed)
            && touching
                .minus(kept)
                .iter()
                .all(|i| at.velocity(i, &after.motion)[1] >= -ROUNDING * speed)
    };
    let tried = touching
        .subsets()
        .into_iter()
        .filter(|kept| kept.meets(landing) && rule.allows(*kept, touching));
    let found = tried
        .filter_map(|kept| Some((kept, at.impact(CornerContact::held(kept))?)))
        .find(|(kept, after)| good(*kept, after));
    let braked = |i: usize| {
        let contact =
            CornerContact { held: touching.minus(landing), sliding: CornerSet::NONE.with(i) };
        let after = at.braked(contact)?;
        let (slip, force) = (at.velocity(i, &after.motion)[0], after.force(i)[0]);
        let good = good(contact.held, &after) && slip * force <= 0.0;
        let stopped = at.impact(CornerContact::held(contact.held.with(i)))?;
        let energy = at.mechanics.kinetic(at.q, at.v) - at.mechanics.kinetic(at.q, &stopped.motion);
        good.then(|| Landed {
            velocity: after.motion,
            held: contact.held,
            sliding: Some((i, -slip.signum(), energy)),
        })
    };
    let (kept, after) = match found {
        Some(found) => found,
        None => match landing.iter().find_map(braked) {
            Some(landed) => return Some(landed),
            // none is good: all stay, which does not add energy either
            None => (touching, at.impact(CornerContact::held(touching))?),
        },
    };
    let afterwards = Configuration::new(at.mechanics, at.q, &after.motion)?;
    let pull = afterwards.accelerations(ground, CornerContact::held(kept))?.motion;
    let stays = |i: &usize| {
        let (speed, pull) =
            (at.velocity(*i, &after.motion)[1], afterwards.acceleration(*i, &pull)[1]);
        // would come back at once: an endless row of ever smaller hops ends here
        let back = pull < 0.0 && speed * speed <= -2.0 * pull * ON_GROUND;
        back || at.speed(*i, &after.motion) <= AT_REST
    };
    let held = kept.and(touching.minus(kept).iter().filter(stays).collect());
    let after = if held == kept { after } else { at.impact(CornerContact::held(held))? };
    Some(Landed { velocity: after.motion, held, sliding: None })
}

fn largest(held: &HeldMotion) -> f64 {
    held.forces.iter().flat_map(|(_, force)| force).fold(0.0, |most, force| most.max(force.abs()))
}

/// What becomes of corners on the ground: contact, accelerations, and whether all of it is
/// consistent: a held corner is pushed, a sliding one braked, and one that goes leaves the ground.
/// `resting`: corners that may be held, at rest; `tried`: sets of them in the order of preference;
/// `sliding`: corners that move along the ground. If nothing is consistent, all that rest stay.
pub(crate) fn stay<M: Mechanics>(
    at: &Configuration<M>,
    ground: [f64; 2],
    CornerContact { held: resting, sliding }: CornerContact,
    tried: &[CornerSet],
    rule: &Rule,
) -> Option<(CornerContact, HeldMotion, bool)> {
    let on_footing =
        |i: usize, set: CornerSet| set.iter().any(|k| rule.footings[k] == rule.footings[i]);
    let sinks = |i: &usize, held: &HeldMotion| at.acceleration(*i, &held.motion)[1] < -ROUNDING_A;
    // first without new sliding, then with
    for slips in [false, true] {
        for &kept in tried.iter().filter(|kept| rule.allows(**kept, resting)) {
            let free = resting.minus(kept);
            let mut contact = CornerContact { held: kept, sliding };
            let Some(mut held) = at.accelerations(ground, contact) else { continue };
            let new: CornerSet = free.iter().filter(|i| sinks(i, &held)).collect();
            if slips
                && !new.is_empty()
                && !new.iter().any(|i| on_footing(i, kept.and(sliding).and(new.without(i))))
            {
                contact.sliding = sliding.and(new);
                let Some(then) = at.accelerations(ground, contact) else { continue };
                held = then;
                // friction brakes
                let driven = |i: usize| {
                    at.acceleration(i, &held.motion)[0] * held.force(i)[0].signum() > ROUNDING_A
                };
                if new.iter().any(driven) {
                    continue;
                }
            }
            let pushed = |i: usize| rule.bound(kept, i) || held.force(i)[1] >= -rule.rounding;
            if kept.iter().all(pushed)
                && !resting.minus(contact.all()).iter().any(|i| sinks(&i, &held))
            {
                return Some((contact, held, true));
            }
        }
    }
    let all = CornerContact { held: resting, sliding };
    Some((all, at.accelerations(ground, all)?, false))
}
