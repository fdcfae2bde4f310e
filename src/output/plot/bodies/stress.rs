//! Von Mises stress in steps of colour: on the bodies, and as a bar beside them.

use super::facets::Facet;
use crate::output::plot::drawing::{
    Canvas, Chart, Colour, Frame, GREY, INK, LegendCell, Letters, Paint, Scale, TextAnchor, cut_off, edges_around, merged,
    number_text, viridis,
};
use crate::output::units::Unit;

/// Steps of the colour bar.
const LEVELS: usize = 40;
/// What is below this share of the largest stress is none.
const UNSTRAINED: f64 = 1e-9;
/// Room for the colour bar beside the plot (pixels).
pub const BAR_ROOM: f64 = 120.0;

/// Von Mises stress from zero to `top` in equal steps of colour; peaks above take the last one.
pub struct Colours {
    top: f64,
    peak: Option<f64>,
}

impl Colours {
    /// Colours for these facets.
    pub fn of(facets: &[Facet]) -> Colours {
        let area = |[a, b, c]: [[f64; 2]; 3]| ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs();
        let weighted: Vec<(f64, f64)> =
            facets.iter().map(|facet| (facet.von_mises.iter().sum::<f64>() / 3.0, area(facet.corners))).collect();
        let high = facets.iter().flat_map(|facet| facet.von_mises).fold(0.0, f64::max);
        // Rigid tools have no stress, however large they are.
        let strained = weighted.into_iter().filter(|(value, _)| *value > UNSTRAINED * high).collect();
        match cut_off(high, strained) {
            Some(top) => Colours { top, peak: Some(high) },
            None => Colours { top: if high > 0.0 { high } else { 1.0 }, peak: None },
        }
    }

    /// What a legend says of a peak above the last colour.
    pub fn remark(&self, unit: Unit) -> Option<LegendCell> {
        self.peak.map(|peak| LegendCell::words(format!("stress up to {}{}", number_text(peak), unit.after())))
    }

    /// Corner values of a facet in steps of colour: level k reaches from k to k + 1.
    fn steps(&self, facet: &Facet) -> [f64; 3] {
        facet.von_mises.map(|value| value / self.top * LEVELS as f64)
    }

    fn level(step: f64) -> usize {
        (step as usize).min(LEVELS - 1)
    }

    fn colour(level: usize) -> Colour {
        viridis(level as f64 / (LEVELS - 1) as f64)
    }
}

/// Draws the triangles, cut into bands of colour and merged where neighbours have the same. A line of that colour closes the
/// hairlines between merged areas.
pub fn draw_stress(canvas: &mut Canvas, chart: &Chart, facets: &[Facet], scale: f64, colours: &Colours) {
    let mut edges = vec![Vec::new(); LEVELS];
    for facet in facets {
        let (corners, steps) = (facet.deformed(scale), colours.steps(facet));
        let [low, high] = [steps.iter().copied().fold(f64::INFINITY, f64::min), steps.iter().copied().fold(0.0, f64::max)];
        let [first, last] = [low, high].map(Colours::level);
        for (level, edges) in edges.iter_mut().enumerate().take(last + 1).skip(first) {
            let upper = if level + 1 < LEVELS { level as f64 + 1.0 } else { f64::INFINITY };
            edges.extend(edges_around(band(&corners, &steps, [level as f64, upper]).into_iter().map(|x| chart.place(x))));
        }
    }
    for (level, edges) in edges.into_iter().enumerate() {
        let colour = Colours::colour(level);
        canvas.path(Paint::fill(colour).edged(colour, 0.4), &merged(edges));
    }
}

/// The part of a triangle where a value, linear between its corners, lies in a range. Neighbours with the same corner values cut
/// their common edge at the same points.
fn band(corners: &[[f64; 2]; 3], values: &[f64; 3], [low, high]: [f64; 2]) -> Vec<[f64; 2]> {
    let mut points = Vec::with_capacity(5);
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        if low <= values[from] && values[from] <= high {
            points.push(corners[from]);
        }
        let rises = values[from] < values[to];
        let [below, above] = if rises { [from, to] } else { [to, from] };
        for limit in if rises { [low, high] } else { [high, low] } {
            if values[below] < limit && limit < values[above] {
                let fraction = (limit - values[below]) / (values[above] - values[below]);
                points.push([0, 1].map(|k| (1.0 - fraction) * corners[below][k] + fraction * corners[above][k]));
            }
        }
    }
    points
}

/// Draws the bar of colours at the right of the plot, with its ticks and its name.
pub fn draw_colour_bar(canvas: &mut Canvas, chart: &Chart, colours: &Colours, unit: Unit) {
    let [_, top, plot, bottom] = chart.frame.0;
    let [left, right] = [plot + 24.0, plot + 40.0];
    let height_of = |fraction: f64| bottom - (bottom - top) * fraction;
    for level in 0..LEVELS {
        let low = height_of(level as f64 / LEVELS as f64); // up to the top: the next ones lie on it, without hairlines between
        canvas.rectangle(Paint::fill(Colours::colour(level)), Frame([left, top, right, low]));
    }
    canvas.rectangle(Paint::line(GREY, 0.8), Frame([left, top, right, bottom]));
    let scale = Scale::linear([0.0, colours.top], 5, "von Mises stress", unit);
    for (share, label) in scale.ticks() {
        let y = height_of(share);
        canvas.line(Paint::line(GREY, 0.8), [[right, y], [right + 4.0, y]]);
        canvas.text(Letters::new(11.0, INK), [right + 7.0, y], label);
    }
    let name = Letters { is_upright: true, ..Letters::new(12.0, INK).at(TextAnchor::Middle) };
    canvas.text(name, [right + 57.0, 0.5 * (top + bottom)], &scale.name);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_of_colour_make_up_the_triangle() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [1.0, 3.0]];
        let area = |points: Vec<[f64; 2]>| {
            let cross = |[a, b]: [[f64; 2]; 2]| 0.5 * (a[0] * b[1] - a[1] * b[0]);
            (0..points.len()).map(|k| cross([points[k], points[(k + 1) % points.len()]])).sum::<f64>()
        };
        for values in [[0.2, 3.7, 1.4], [2.0, 2.0, 0.0], [1.0, 1.5, 1.0], [2.5; 3]] {
            let sum: f64 = (0..4).map(|level| area(band(&corners, &values, [level as f64, level as f64 + 1.0]))).sum();
            assert!((sum - 6.0).abs() < 1e-14, "{values:?}: {sum}");
        }
        assert_eq!(band(&corners, &[0.0, 4.0, 4.0], [1.0, 2.0]).len(), 4);
    }
}
