//! Bodies cut into rows of triangles that grow away from the seam: unstructured, jittered, and as fine as wished at the seam.

use crate::support::mesh::{Block, Random};

/// How a body is meshed.
#[derive(Clone, Debug)]
pub struct Layers {
    /// Edge length on the seam at a parameter from 0 to 1, in parameters.
    pub peaks: Vec<Peak>,
    /// The longest edge on the seam, in parameters.
    pub edge: f64,
    /// Depth of the body, in units of the seam's length.
    pub depth: f64,
    /// How far nodes are moved at random, in edges.
    pub jitter: f64,
    pub seed: u64,
}

/// A place where edges are shorter.
#[derive(Clone, Copy, Debug)]
pub struct Peak {
    pub at: f64,
    pub reach: f64,
    pub edge: f64,
}

impl Layers {
    /// Even edges on the seam.
    pub fn even(count: usize, depth: f64, jitter: f64, seed: u64) -> Self {
        Self { peaks: Vec::new(), edge: 1.0 / count as f64, depth, jitter, seed }
    }

    /// Edge length wanted at a parameter and a depth.
    fn size(&self, u: f64, depth: f64) -> f64 {
        let along = self.peaks.iter().map(|peak| peak.edge + 0.5 * ((u - peak.at).abs() - peak.reach).max(0.0));
        along.fold(self.edge, f64::min).max(0.45 * depth)
    }

    /// Parameters of the nodes at a depth.
    fn row(&self, depth: f64) -> Vec<f64> {
        const STEPS: usize = 4000;
        let mut sums = vec![0.0];
        for k in 0..STEPS {
            let u = (k as f64 + 0.5) / STEPS as f64;
            sums.push(sums[k] + 1.0 / (STEPS as f64 * self.size(u, depth)));
        }
        let count = (sums[STEPS].round() as usize).max(2);
        let mut k = 0;
        let mut place = |i: usize| {
            let wanted = sums[STEPS] * i as f64 / count as f64;
            while k + 1 < STEPS && sums[k + 1] < wanted {
                k += 1;
            }
            ((k as f64 + (wanted - sums[k]) / (sums[k + 1] - sums[k])) / STEPS as f64).clamp(0.0, 1.0)
        };
        let mut row: Vec<f64> = (0..=count).map(&mut place).collect();
        row[count] = 1.0;
        row
    }

    /// Depths of the rows, from 0 to `depth`.
    fn depths(&self) -> Vec<f64> {
        let finest = |depth| (0..=400).map(|k| self.size(k as f64 / 400.0, depth)).fold(f64::INFINITY, f64::min);
        let mut depths = vec![0.0];
        while depths[depths.len() - 1] < self.depth {
            let last = depths[depths.len() - 1];
            depths.push(last + 0.9 * finest(last + 0.5 * finest(last)));
        }
        let stretch = self.depth / depths[depths.len() - 1];
        depths.iter().map(|depth| depth * stretch).collect()
    }

    /// The body: `place` gives the point at a parameter and a share of the depth. Its sides are seam, right, outer, left.
    pub fn block(&self, place: impl Fn(f64, f64) -> [f64; 2]) -> Block {
        let mut random = Random(self.seed);
        let depths = self.depths();
        let last = depths.len() - 1;
        let (mut points, mut rows) = (Vec::new(), Vec::new());
        for (j, depth) in depths.iter().enumerate() {
            let mut shake = |free: bool| if free { self.jitter * (2.0 * random.next() - 1.0) } else { 0.0 };
            let row = self.row(*depth);
            let step = if j == last { depths[j] - depths[j - 1] } else { depths[j + 1] - depths[j] };
            let ends = row.len() - 1;
            let mut ids = Vec::new();
            for i in 0..=ends {
                let inner = i > 0 && i < ends;
                let along = if inner { (row[i + 1] - row[i]).min(row[i] - row[i - 1]) } else { 0.0 };
                let u = row[i] + shake(inner) * along;
                let v = depth + shake(j > 0 && j < last) * 0.5 * step;
                ids.push((points.len(), u));
                points.push(place(u, v / self.depth));
            }
            rows.push(ids);
        }
        let mut triangles = Vec::new();
        for pair in rows.windows(2) {
            triangles.extend(strip(&pair[0], &pair[1], &points));
        }
        let along = |row: &[(usize, f64)]| row.windows(2).map(|pair| [pair[0].0, pair[1].0]).collect::<Vec<_>>();
        let side = |end: fn(&[(usize, f64)]) -> usize| rows.windows(2).map(|pair| [end(&pair[0]), end(&pair[1])]).collect();
        let sides = [along(&rows[0]), side(|row| row[row.len() - 1].0), along(&rows[last]), side(|row| row[0].0)];
        Block { points, triangles, sides }
    }
}

/// Triangles between two rows of nodes, counter-clockwise, each with the shorter of two diagonals.
fn strip(low: &[(usize, f64)], high: &[(usize, f64)], points: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let (mut i, mut j) = (0, 0);
    let mut triangles = Vec::new();
    while i + 1 < low.len() || j + 1 < high.len() {
        let far = |a: usize, b: usize| (points[a][0] - points[b][0]).hypot(points[a][1] - points[b][1]);
        let forward = match (low.get(i + 1), high.get(j + 1)) {
            (Some(a), Some(b)) => far(a.0, high[j].0) <= far(low[i].0, b.0),
            (next, _) => next.is_some(),
        };
        let mut triangle = [low[i].0, if forward { low[i + 1].0 } else { high[j + 1].0 }, high[j].0];
        if area(triangle.map(|k| points[k])) < 0.0 {
            triangle.swap(1, 2);
        }
        triangles.push(triangle);
        if forward { i += 1 } else { j += 1 }
    }
    triangles
}

/// Twice the area of a triangle, negative if it is clockwise.
fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
