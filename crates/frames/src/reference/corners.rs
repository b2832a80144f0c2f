//! Sets of corners.

/// A set of corners, by number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CornerSet(u32);

impl CornerSet {
    /// Most corners a structure may have: every set of them may be looked at.
    pub(crate) const MOST: usize = 16;

    /// No corner.
    pub const NONE: Self = Self(0);

    /// Whether a corner is one of them.
    pub fn contains(self, i: usize) -> bool {
        self.0 >> i & 1 == 1
    }

    /// With a corner.
    #[must_use]
    pub fn with(self, i: usize) -> Self {
        Self(self.0 | 1 << i)
    }

    /// Without a corner.
    #[must_use]
    pub(crate) fn without(self, i: usize) -> Self {
        Self(self.0 & !(1 << i))
    }

    /// Those of either set.
    #[must_use]
    pub(crate) fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Those that the other set does not have.
    #[must_use]
    pub(crate) fn minus(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// How many.
    pub fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether there is none.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Whether the two share a corner.
    pub(crate) fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// The corners, from the left.
    pub fn iter(self) -> impl Iterator<Item = usize> + Clone {
        let mut left = self.0;
        std::iter::from_fn(move || {
            let i = left.trailing_zeros() as usize;
            left &= left.wrapping_sub(1);
            (i < 32).then_some(i)
        })
    }

    /// All its subsets, itself and the empty one among them; sets of fewer corners come first.
    pub(crate) fn subsets(self) -> Vec<Self> {
        let mut all = vec![Self::NONE];
        for i in self.iter() {
            for k in 0..all.len() {
                all.push(all[k].with(i));
            }
        }
        all.sort_by_key(|set| (set.len(), set.0));
        all
    }
}

impl FromIterator<usize> for CornerSet {
    fn from_iter<I: IntoIterator<Item = usize>>(corners: I) -> Self {
        corners.into_iter().fold(Self::NONE, Self::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_of_three_has_eight_subsets_small_ones_first() {
        let set = CornerSet::from_iter([3, 0, 2]);
        assert_eq!(set.iter().collect::<Vec<_>>(), [0, 2, 3]);
        let subsets = set.subsets();
        assert_eq!(subsets.iter().map(|s| s.len()).collect::<Vec<_>>(), [0, 1, 1, 1, 2, 2, 2, 3]);
        assert!(subsets[7] == set && subsets[0].is_empty() && !subsets[1].meets(subsets[2]));
        assert_eq!(set.minus(CornerSet::NONE.with(2)), set.without(2));
        assert_eq!(subsets[1].and(subsets[2]), CornerSet::from_iter([0, 2]));
    }
}
