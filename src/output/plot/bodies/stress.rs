//! A measure of the stress in steps of colour: on the bodies, and as a bar beside them.

use super::facets::Facet;
use crate::element::{MEASURE_NAMES, MEASURES, StressMeasure};
use crate::output::plot::drawing::*;
use crate::output::units::Unit;

/// Steps of the colour bar.
const LEVELS: usize = 40;
/// What is below this share of the largest stress is none.
const UNSTRAINED: f64 = 1e-9;
/// Room for the colour bar beside the plot (pixels).
pub const BAR_ROOM: f64 = 120.0;

/// A measure of the stress in equal steps of colour, over a range with zero in it; peaks beyond take the colour of the nearest end.
/// What has a sign has two colours, both as strong as its larger end wants them.
pub struct Colours {
    measure: StressMeasure,
    range: [f64; 2],
    /// The whole range of the facets, where it is cut.
    whole: Option<[f64; 2]>,
}

impl Colours {
    /// Colours for these facets.
    pub fn of(facets: &[Facet], measure: StressMeasure) -> Colours {
        let area = |[a, b, c]: [[f64; 2]; 3]| ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs();
        let size = |facet: &Facet| facet.values(measure).iter().sum::<f64>().abs() / 3.0;
        let values = facets.iter().flat_map(|facet| facet.values(measure));
        let whole = values.fold([0.0_f64; 2], |[low, high], value| [low.min(value), high.max(value)]);
        let largest = whole[1].max(-whole[0]);
        // Rigid tools have no stress, however large they are.
        let strained = facets.iter().map(|facet| (size(facet), area(facet.corners)));
        match cut_off(largest, strained.filter(|(size, _)| *size > UNSTRAINED * largest).collect()) {
            Some(top) => Colours { measure, range: whole.map(|end| end.clamp(-top, top)), whole: Some(whole) },
            None => Colours { measure, range: if largest > 0.0 { whole } else { [0.0, 1.0] }, whole: None },
        }
    }

    /// What a legend says of peaks beyond the last colour.
    pub fn remark(&self, unit: Unit) -> Option<LegendCell> {
        let [low, high] = self.whole?.map(number_text);
        let range = if self.measure.is_signed() { format!("from {low} to {high}") } else { format!("up to {high}") };
        Some(LegendCell::words(format!("stress {range}{}", unit.after())))
    }

    /// Corner values of a facet in steps of colour: level k reaches from k to k + 1.
    fn steps(&self, facet: &Facet) -> [f64; 3] {
        let [low, high] = self.range;
        facet.values(self.measure).map(|value| (value - low) / (high - low) * LEVELS as f64)
    }

    fn level(step: f64) -> usize {
        (step as usize).min(LEVELS - 1)
    }

    fn colour(&self, level: usize) -> Colour {
        let [low, high] = self.range;
        match self.measure.is_signed() {
            true => diverging((low + (level as f64 + 0.5) / LEVELS as f64 * (high - low)) / high.max(-low)),
            false => viridis(level as f64 / (LEVELS - 1) as f64),
        }
    }

    /// What the colours are of.
    fn name(&self, has_axis: bool) -> &'static str {
        match self.measure {
            StressMeasure::VonMises => "von Mises stress",
            StressMeasure::First => "larger principal stress σ₁ in the plane",
            StressMeasure::Second => "smaller principal stress σ₂ in the plane",
            StressMeasure::Shear => "largest shear stress τ",
            StressMeasure::Radial => "radial stress σ rr",
            StressMeasure::Xx if has_axis => "radial stress σ xx",
            StressMeasure::Yy if has_axis => "axial stress σ yy",
            StressMeasure::Hoop => "hoop stress",
            StressMeasure::Xx => "stress σ xx",
            StressMeasure::Yy => "stress σ yy",
            StressMeasure::Xy => "shear stress σ xy",
            StressMeasure::Zz => "stress σ zz across the plane",
        }
    }
}

/// The file of the figure of a measure.
pub fn stress_file(measure: StressMeasure) -> String {
    let at = MEASURES.iter().position(|other| *other == measure);
    at.map_or("deformed.svg".into(), |at| format!("field_{}.svg", MEASURE_NAMES[at]))
}

/// Draws the triangles, cut into bands of colour and merged where neighbours have the same. A line of that colour closes the
/// hairlines between merged areas.
pub fn draw_stress(canvas: &mut Canvas, chart: &Chart, facets: &[Facet], scale: f64, colours: &Colours) {
    let mut edges = vec![Vec::new(); LEVELS];
    for facet in facets {
        let (corners, steps) = (facet.deformed(scale), colours.steps(facet));
        let [first, last] = range_of(steps.into_iter()).map(Colours::level);
        for (level, edges) in edges.iter_mut().enumerate().take(last + 1).skip(first) {
            let lower = if level > 0 { level as f64 } else { f64::NEG_INFINITY };
            let upper = if level + 1 < LEVELS { level as f64 + 1.0 } else { f64::INFINITY };
            edges.extend(edges_around(band(&corners, &steps, [lower, upper]).into_iter().map(|x| chart.place(x))));
        }
    }
    for (level, edges) in edges.into_iter().enumerate() {
        let colour = colours.colour(level);
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
        canvas.rectangle(Paint::fill(colours.colour(level)), Frame([left, top, right, low]));
    }
    canvas.rectangle(Paint::line(GREY, 0.8), Frame([left, top, right, bottom]));
    let scale = Scale::linear(colours.range, 5, colours.name(chart.has_axis), unit);
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
