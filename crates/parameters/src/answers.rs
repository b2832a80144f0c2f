//! Both models' answers to one record, or to many: Housner's rigid body and the finite elements on
//! ground springs, and what they say together.

use dynamics::compare::Match;
use std::convert::Infallible;

use crate::Parameters;
use dynamics::{
    fem::{self, Demands, History, Landing},
    spring::{Chain, Springs},
};
use rocking::{
    conditioning::Conditioning,
    housner::{self, Rocking},
    members::Members,
    motion::{Motion, TimedPeak, samples_until},
    structure::Body,
};
use strong_motion::Record;
use validation::{JudgedModel, Validation, Validator, verdict::Verdict};

/// Both models' answers to one record.
pub struct ModelComparison {
    /// Housner's history; its `outcome` says how it ended.
    pub rocking: Rocking<f64>,
    /// Housner's history without the vertical component, if the record has one.
    pub housner_without_vertical: Option<Rocking<f64>>,
    /// Motion of the centre of mass in Housner's history.
    pub housner: Motion,
    /// The finite element history of the rigid body; its `outcome` says how it ended.
    pub fem: fem::History,
    /// How it matches Housner's.
    pub matched: Match,
    /// Forces in the rigid body's history.
    pub demands: fem::Demands,
    /// The finite element history with members, if there are any.
    pub with: Option<MemberHistory>,
}

/// Run both models over a record; with members, the finite elements once more with them.
pub fn compare_models(
    body: &Body<f64>,
    restitution: f64,
    springs: &Springs<Chain>,
    members: &Members,
    record: &Record,
) -> ModelComparison {
    let options = housner::RockingOptions::on(record, restitution);
    let without_vertical = housner::RockingOptions { vertical: None, ..options.clone() };
    let rocking = housner::solve(body, record.dt, &record.accel, &options);
    let housner_without_vertical = record
        .vertical
        .as_ref()
        .map(|_| housner::solve(body, record.dt, &record.accel, &without_vertical));
    let motion = rocking.motion(body);
    let answer = |members: &Members| {
        with_members(body, restitution, springs, members, record, (&rocking, &motion))
    };
    let MemberHistory { history: fem, demands, matched, .. } = answer(&Members::default());
    let with = (!members.is_none()).then(|| answer(members));
    ModelComparison {
        rocking,
        housner_without_vertical,
        housner: motion,
        fem,
        matched,
        demands,
        with,
    }
}

/// The finite elements with members through a record, beside Housner's equation with a tendon and
/// dampers, or with friction beside the history that he has of the bare body, and its motion.
pub fn with_members(
    body: &Body<f64>,
    restitution: f64,
    springs: &Springs<Chain>,
    members: &Members,
    record: &Record,
    (rocking, motion): (&Rocking<f64>, &Motion),
) -> MemberHistory {
    let case = fem::Analysis {
        vertical: record.up(),
        ..fem::Analysis::new(*body, *springs, record.dt, &record.accel)
    };
    let (history, mut demands) = case.simulate_with(members);
    let options = housner::RockingOptions::on(record, restitution).with_members(*members);
    let rigid = members.act().then(|| housner::solve(body, record.dt, &record.accel, &options));
    let housner = rigid.as_ref().map(|rigid| rigid.motion(body));
    let reference = housner.as_ref().unwrap_or(motion);
    let impacts = &rigid.as_ref().unwrap_or(rocking).impacts;
    let answers = (reference, &impacts[..]);
    let mut matched =
        Match::with_members(body, *members, record.dt, answers, &history, restitution);
    // Housner's solution locates what his samples only enclose
    let located = rigid.as_ref().unwrap_or(rocking).overturned();
    if let Some((sampled, located)) = matched.overturned_housner_s.as_mut().zip(located)
        && (located - *sampled).abs() < record.dt
    {
        *sampled = located;
    }
    count(&mut demands, body, record.dt, &history.landings, matched.overturned_fem_s);
    MemberHistory { members: *members, rocking: rigid, housner, history, demands, matched }
}

/// Both models on the springs and members of a parameter file, and what they say together: peaks,
/// overturning, match.
///
/// It never fails: of a history that met its bound on work, found no balance or has numbers that
/// are not finite, the [`Verdict`] has `Fate::Failed`, and its `outcome` says why and when. The
/// match is then over the samples that both histories have.
pub fn compare(parameters: &Parameters, record: &Record) -> (ModelComparison, Verdict) {
    let (body, e) = (parameters.structure.body(), parameters.restitution());
    let both = compare_models(&body, e, &parameters.chains(), &parameters.members(), record);
    let options = housner::RockingOptions::on(record, e);
    let verdict = both.verdict(
        &body,
        record.dt,
        &Conditioning::new(&body, record.dt, &record.accel, &options),
    );
    (both, verdict)
}

/// The springs of a parameter file over many records, each as long as it is, on all cores.
///
/// Members and vertical components are left out. It never fails: a record in which a history did
/// has a row with `RecordOutcome::HousnerFailed` or `FemFailed` and no errors, and its name in
/// `failed`; it counts as a disagreement on overturning and as an infinite error in the quantiles.
pub fn validate(parameters: &Parameters, records: &[Record]) -> Validation {
    let judge = Validator {
        body: parameters.structure.body(),
        restitution: parameters.restitution(),
        duration_s: None,
        model: JudgedModel::Events {
            springs: parameters.chains(),
            control: fem::Control::default(),
        },
    };
    let Ok(validation) =
        judge.judge_all(records.len(), |i| Ok::<_, Infallible>(records[i].clone()), |_| ());
    validation
}

impl ModelComparison {
    /// The history on springs that answers for the structure: with its members, if it has any.
    pub fn answer(&self) -> &History {
        self.with.as_ref().map_or(&self.fem, |with| &with.history)
    }

    /// What the histories say together; `dt` in s.
    #[doc(hidden)]
    pub fn verdict(&self, body: &Body<f64>, dt: f64, conditioning: &Conditioning) -> Verdict {
        let verdict =
            Verdict::new(body, dt, (&self.rocking, &self.fem), &self.matched, conditioning);
        match &self.housner_without_vertical {
            Some(level) => verdict.beside(body, dt, level),
            None => verdict,
        }
    }
}

/// A history with members, and what it says.
pub struct MemberHistory {
    /// What the body has besides.
    pub members: Members,
    /// Housner's history of a body with a tendon or dampers; none with friction, on which feet may
    /// slip.
    pub rocking: Option<Rocking<f64>>,
    /// Motion of the centre of mass in it.
    pub housner: Option<Motion>,
    /// The finite element history with them.
    pub history: History,
    /// Forces in it.
    pub demands: Demands,
    /// How it matches Housner's with them; with friction, that of the bare body.
    pub matched: Match,
}

/// The largest forces of a history, those between its landings apart, up to an overturning.
fn count(
    demands: &mut Demands,
    body: &Body<f64>,
    dt: f64,
    landings: &[Landing],
    overturned: Option<f64>,
) {
    peaks_until(demands, dt, overturned);
    demands.separate(body, dt, landings, samples_until(overturned, dt));
}

/// Count the largest forces up to an overturning only, if there is one: those of the fall and of
/// the body on the ground are no demand of rocking. Times are then those of the samples.
fn peaks_until(demands: &mut Demands, dt: f64, overturned: Option<f64>) {
    let Some(_) = overturned else { return };
    demands.peaks = Default::default();
    for (i, row) in demands.rows.iter().enumerate().take(samples_until(overturned, dt)) {
        for (peak, &value) in demands.peaks.iter_mut().zip(row) {
            if value.abs() > peak.value.abs() {
                *peak = TimedPeak { value, time: i as f64 * dt };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dynamics::{fem::QUANTITIES, spring::Design};
    use rocking::{
        members::{Damper, Tendon},
        motion::nrmse,
        structure::Structure,
    };

    /// A pier that falls from 0.3 alpha: its foot carries about its weight while it turns about it,
    /// and far more in a landing.
    #[test]
    fn forces_between_landings_are_about_the_weight_whatever_the_springs() {
        let structure = Structure::a_frame(9.0, 2.1, 120e3).unwrap();
        let record =
            Record::new("pulse", 0.01, (0..1000).map(|i| if i < 25 { 4.0 } else { 0.0 }).collect())
                .unwrap();
        for hz in [320.0, 1280.0] {
            let design = Design::from_kc(0.3, 0.1, 0.75, hz);
            let springs =
                Springs { vertical: design, horizontal: design }.chains(structure.mass_kg);
            let both =
                compare_models(&structure.body(), 0.97, &springs, &Members::default(), &record);
            assert!(both.fem.impacts() > 3);
            let weight = structure.mass_kg * rocking::scalar::GRAVITY;
            // the leg carries m g R cos(alpha - theta) less the centrifugal force, in compression
            for k in [1, 4] {
                let [all, between] = [both.demands.peaks, both.demands.between]
                    .map(|peaks| -peaks[k].value / weight);
                assert!((0.95..1.3).contains(&between) && all > 10.0, "{hz} Hz: {between}, {all}");
            }
        }
    }

    /// With a tendon and dampers the finite elements follow Housner's equation with these, and
    /// their landings give back what his do; the bare body moves otherwise.
    #[test]
    fn springs_follow_housners_equation_with_members() {
        let structure = Structure::a_frame(8.9, 2.1, 120e3).unwrap();
        let body = structure.body::<f64>();
        let sine = |i: i32| {
            let t = 0.01 * f64::from(i);
            if t < 3.0 { 2.2 * (4.0 * t).sin() } else { 0.0 }
        };
        let record = Record::new("sine", 0.01, (0..700).map(sine).collect()).unwrap();
        let design = Design::from_kc(0.25, 0.1, 0.75, 2e4);
        let springs = Springs { vertical: design, horizontal: design }.chains(120e3);
        let members = Members {
            tendon: Some(Tendon { stiffness: 2e6, pretension: 2e5 }),
            damper: Some(Damper { c: 2e5 }),
            friction: None,
        };
        let of = |members| compare_models(&body, body.restitution(), &springs, &members, &record);
        let both = of(members);
        let with = both.with.as_ref().unwrap();
        let matched = &with.matched;
        assert!(matched.impacts_housner_firm > Some(4), "{matched:?}");
        assert_eq!(matched.impacts_housner_firm, matched.impacts_fem_firm);
        assert_eq!([with.history.motion.len(), with.housner.as_ref().unwrap().len()], [700; 2]);
        let (reference, bare) = (matched.peak_horizontal_housner_m, &both.matched);
        assert!(matched.nrmse_horizontal < 2e-3, "{matched:?}");
        assert!((matched.peak_horizontal_fem_m / reference - 1.0).abs() < 1e-3, "{matched:?}");
        // those of springs without members: dampers are not counted as a loss of landings
        let firm = [matched, bare].map(|m| m.restitution_error_firm.unwrap());
        assert!(firm[0] < 2.0 * firm[1] + 1e-3, "{firm:?}");
        let apart = nrmse(&both.housner.u, &with.housner.as_ref().unwrap().u);
        assert!(apart > 0.1, "{apart}");
        // feet on friction may slip: there is no such equation
        let friction = Some(rocking::members::Friction { coefficient: 0.8 });
        let slips = of(Members { friction, ..Members::default() });
        assert!(slips.with.unwrap().housner.is_none());
    }

    /// A steady push from rest: theta'^2/2 is the integral of equation 1, and the time to alpha is
    /// that of 1/theta', regular in s, theta = s^2.
    #[test]
    fn housners_overturning_is_when_his_solution_passes_alpha() {
        let structure = Structure::block(2.0, 0.5, 1e3).unwrap();
        let body = structure.body::<f64>();
        let (alpha, push) = (body.alpha(), 2.0 * body.alpha().tan());
        let energy = |theta: f64| {
            let left = alpha - theta;
            push * (alpha.sin() - left.sin()) - (left.cos() - alpha.cos())
        };
        let integrand = |s: f64| {
            let slope = push * alpha.cos() - alpha.sin();
            let over_theta = if s > 1e-6 { energy(s * s) / (s * s) } else { slope };
            2.0 / (body.p() * (2.0 * over_theta).sqrt())
        };
        let (n, end) = (2000, alpha.sqrt());
        let simpson = |i: usize| match i {
            i if i == 0 || i == n => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let step = end / n as f64;
        let time: f64 = (0..=n).map(|i| simpson(i) * integrand(i as f64 * step)).sum();
        let time = time * step / 3.0;
        let accel = vec![push * rocking::scalar::GRAVITY; 400];
        let record = Record::new("push", 0.02, accel).unwrap();
        let design = Design::from_kc(0.3, 0.1, 0.75, 320.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(structure.mass_kg);
        let found =
            compare_models(&body, body.restitution(), &springs, &Members::default(), &record);
        let told = found.matched.overturned_housner_s.unwrap();
        assert!((told - time).abs() < 1e-7, "{told} {time}");
    }

    #[test]
    fn the_largest_forces_are_those_before_the_fall() {
        let mut demands = Demands::default();
        demands.rows = [1.0, -3.0, 2.0, 50.0].map(|x| [x; QUANTITIES.len()]).to_vec();
        demands.peaks = [TimedPeak { value: 50.0, time: 0.033 }; QUANTITIES.len()];
        let whole = demands.clone();
        peaks_until(&mut demands, 0.01, None);
        assert_eq!(demands, whole);
        peaks_until(&mut demands, 0.01, Some(0.025));
        assert_eq!(demands.peaks[0], TimedPeak { value: -3.0, time: 0.01 });
    }
}
