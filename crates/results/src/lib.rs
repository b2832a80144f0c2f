//! What a run found, as data: peaks, design forces, findings. Words for them are in `findings`
//! alone; `report` lays them out.

pub mod findings;
pub mod forces;
pub mod member_motion;
mod peaks;

pub use findings::{
    DeckEnd, Ending, FiledFinding, Finding, FindingModel, ForceName, NotDone, NotToBeUsed,
    PeakChange, ProgramAdvice, ProgramFault, Weight, feet_end,
};
pub use forces::{CornerForce, DesignForce, DesignForces};
pub use frames::design_forces::{ForcesTogether, MOST_CHANGE, OtherForces};
pub use member_motion::{DamperMotion, TendonMotion};
pub use peaks::{ForetoldPeaks, PartsOfTop, PeakPair, PeakTimes, Peaks};

/// Up to when a motion can be foretold (s), if that is not all of it.
pub fn predictable_to(findings: &[FiledFinding]) -> Option<f64> {
    // with members the springs answer, which go on where Housner's pivot lets go
    let beside = findings.iter().any(|f| matches!(f.finding, Finding::MembersBeside { .. }));
    let own =
        |f: &&FiledFinding| !(beside && matches!(f.finding, Finding::PivotLeavesGround { .. }));
    findings.iter().filter(own).filter_map(|f| f.finding.predictable_to()).reduce(f64::min)
}
