//! Boxes on a canvas.

/// A box: left, top, right, bottom (pixels).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame(pub [f64; 4]);

impl Frame {
    /// A box by its upper left corner, its width and its height.
    pub fn at([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Self {
        Self([x, y, x + width, y + height])
    }

    /// A box by its middle, its width and its height.
    pub fn around([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Self {
        Self::at([x - 0.5 * width, y - 0.5 * height], [width, height])
    }

    /// The box without a margin on all sides.
    pub fn shrunk(&self, margin: f64) -> Self {
        let [left, top, right, bottom] = self.0;
        Self([left + margin, top + margin, right - margin, bottom - margin])
    }

    /// The smallest box around both.
    pub fn with(&self, other: &Self) -> Self {
        let ([left, top, right, bottom], other) = (self.0, other.0);
        Self([left.min(other[0]), top.min(other[1]), right.max(other[2]), bottom.max(other[3])])
    }

    /// Its width and its height.
    pub fn extent(&self) -> [f64; 2] {
        let [left, top, right, bottom] = self.0;
        [right - left, bottom - top]
    }

    /// Its middle.
    pub fn middle(&self) -> [f64; 2] {
        let [left, top, right, bottom] = self.0;
        [0.5 * (left + right), 0.5 * (top + bottom)]
    }

    /// Its point that is nearest to a place.
    pub fn nearest(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, top, right, bottom] = self.0;
        [x.max(left).min(right), y.max(top).min(bottom)]
    }

    /// Whether a place lies in it.
    pub fn holds(&self, place: [f64; 2]) -> bool {
        self.nearest(place) == place
    }

    /// Area that two boxes share.
    pub fn shared(&self, other: &Self) -> f64 {
        let (a, b) = (self.0, other.0);
        let along = |low: usize| (a[low + 2].min(b[low + 2]) - a[low].max(b[low])).max(0.0);
        along(0) * along(1)
    }

    /// Area that lies outside another box.
    pub fn outside(&self, other: &Self) -> f64 {
        self.shared(self) - self.shared(other)
    }
}
