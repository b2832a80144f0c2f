//! The samples of a history, or what they come to.

use crate::scalar::Scalar;

/// WalkSamples of a history, kept, or only looked at.
pub(crate) struct WalkSamples<S> {
    kept: bool,
    /// theta (rad) and theta' (rad/s), where they are kept.
    pub theta: Vec<S>,
    pub rate: Vec<S>,
    /// Where they are not: how many there are, the largest |theta|, the last theta and theta'.
    pub count: usize,
    pub peak: f64,
    pub last: (f64, f64),
}

impl<S: Scalar> WalkSamples<S> {
    /// To keep, with room for n.
    pub(crate) fn kept(n: usize) -> Self {
        let (theta, rate) = (Vec::with_capacity(n), Vec::with_capacity(n));
        Self { kept: true, theta, rate, ..Self::looked_at() }
    }

    /// To look at.
    pub(crate) fn looked_at() -> Self {
        let (theta, rate) = (Vec::new(), Vec::new());
        Self { kept: false, theta, rate, count: 0, peak: 0.0, last: (0.0, 0.0) }
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, theta: S, rate: S) {
        if self.kept {
            self.theta.push(theta);
            self.rate.push(rate);
        } else {
            self.look(theta.re(), rate.re());
        }
    }

    /// n more at rest.
    pub(crate) fn rest(&mut self, n: usize) {
        if self.kept {
            self.theta.resize(self.theta.len() + n, S::zero());
            self.rate.resize(self.rate.len() + n, S::zero());
        } else if n > 0 {
            self.count += n;
            self.last = (0.0, 0.0);
        }
    }

    // not in line: it would slow those that keep their samples
    #[inline(never)]
    fn look(&mut self, theta: f64, rate: f64) {
        self.count += 1;
        self.peak = self.peak.max(theta.abs());
        self.last = (theta, rate);
    }
}

impl WalkSamples<f64> {
    /// WalkSamples that follow each other, theta and theta'.
    pub(crate) fn extend(
        &mut self,
        theta: impl ExactSizeIterator<Item = f64>,
        rate: impl ExactSizeIterator<Item = f64>,
    ) {
        if self.kept {
            self.theta.extend(theta);
            self.rate.extend(rate);
        } else {
            for (theta, rate) in theta.zip(rate) {
                self.count += 1;
                self.peak = self.peak.max(theta.abs());
                self.last = (theta, rate);
            }
        }
    }
}
