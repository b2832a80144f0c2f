//! Where a deck of steps of one size ends, and how far it is compared.

/// What ends a deck of steps of one size, and its comparison.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EvenEnds {
    /// When the emulation gives up on the record, which is where the deck ends (s).
    pub gives_up_s: Option<f64>,
    /// When the structure has fallen over in these steps, if it does (s).
    pub falls_s: Option<f64>,
    /// Whether a comparison that ends before the history does so because of these steps on these
    /// springs, not of the structure's motion.
    pub compared_by_steps: bool,
}

impl EvenEnds {
    /// Why nothing is compared beyond some time; of the default, as of a deck whose steps follow
    /// touches, the motion.
    pub(crate) fn beyond(&self) -> &'static str {
        match self.compared_by_steps {
            true => "these steps on these springs cannot be compared",
            false => "the motion cannot be predicted",
        }
    }
}
