//! Which macro triangles are refined next.

/// Indicators that are nearer to each other than this share are taken for equal, so that rounding marks nothing.
const MARGIN: f64 = 1e-3;

/// The fewest triangles that hold a share of the sum of all indicators; with them those whose indicators are as good
/// as equal to the least of theirs. In ascending order.
pub(crate) fn marked(share: f64, indicators: &[f64]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..indicators.len() as u32).collect();
    let value = |triangle: u32| indicators[triangle as usize];
    order.sort_by(|&a, &b| value(b).total_cmp(&value(a)));
    let whole: f64 = order.iter().map(|&triangle| value(triangle)).sum();
    let (mut sum, mut count) = (0.0, 0);
    while count < order.len() && sum < share * whole {
        sum += value(order[count]);
        count += 1;
    }
    let least = if count > 0 { (1.0 - MARGIN) * value(order[count - 1]) } else { f64::INFINITY };
    count += order[count..].iter().take_while(|&&triangle| value(triangle) > least).count();
    order.truncate(count);
    order.sort_unstable();
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_triangles_hold_most_of_the_sum() {
        let indicators = [0.1, 4.0, 0.2, 3.0, 0.3, 2.0];
        assert_eq!(marked(0.6, &indicators), [1, 3], "7 of 9.6");
        assert!(marked(0.6, &[]).is_empty());
        assert!(marked(0.6, &[0.0; 3]).is_empty());
    }

    #[test]
    fn rounding_marks_nothing() {
        // A symmetric mesh: the first two would hold the share, the third is their like but for rounding.
        let indicators = [1.0, 1.0 - 1e-9, 1.0 + 1e-9, 0.5];
        assert_eq!(marked(0.6, &indicators), [0, 1, 2]);
    }
}
