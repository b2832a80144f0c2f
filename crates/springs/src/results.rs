//! What a run found, as data: peaks, design forces, findings. Words for them are in `findings`
//! alone; `report` lays them out.

pub mod findings;
pub mod forces;
pub mod peaks;

pub use findings::{
    DeckEnd, Ending, FiledFinding, Finding, FindingModel, ForceName, NotDone, PeakChange, Weight,
    apart_words,
};
pub use forces::{DesignForce, DesignForces};
pub use frames::design_forces::{ForcesTogether, MOST_CHANGE, OtherForces};
pub use peaks::{ForetoldPeaks, PartsOfTop, PeakPair, PeakTimes, Peaks};
