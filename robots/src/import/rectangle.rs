//! Cover of the occupied cells of a map by few rectangles.

/// Rectangle of cells, from its first column and row up to but without its last.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Rectangle {
    pub(super) columns: [usize; 2],
    pub(super) rows: [usize; 2],
}

/// Covers the occupied cells, each exactly once, from the first row on. At each first cell that is left, the
/// larger of two rectangles is taken: widest first, or highest first. A cover with the fewest rectangles is
/// a matching problem; this one is linear in the cells but for the walks that overlap. O(cells · side).
pub(super) fn cover(occupied: &[bool], width: usize) -> Vec<Rectangle> {
    let mut left = occupied.to_vec();
    let mut found = Vec::new();
    let mut from = 0;
    while let Some(step) = left.get(from..).and_then(|rest| rest.iter().position(|is| *is)) {
        from += step;
        let (row, column) = (from / width, from % width);
        let [wide, high] = [widest(&left, width, row, column), highest(&left, width, row, column)];
        let best = if area(high) > area(wide) { high } else { wide };
        for row in best.rows[0]..best.rows[1] {
            let cells = row * width + best.columns[0]..row * width + best.columns[1];
            left.get_mut(cells).into_iter().flatten().for_each(|cell| *cell = false);
        }
        found.push(best);
    }
    found
}

fn area(rectangle: Rectangle) -> usize {
    (rectangle.columns[1] - rectangle.columns[0]) * (rectangle.rows[1] - rectangle.rows[0])
}

fn widest(left: &[bool], width: usize, row: usize, column: usize) -> Rectangle {
    let run = run_of(left, width, row, column);
    let is_full = |row: &usize| {
        let cells = row * width + column..row * width + column + run;
        left.get(cells).is_some_and(|cells| cells.iter().all(|is| *is))
    };
    let rows = (row..left.len() / width).take_while(is_full).count();
    Rectangle { columns: [column, column + run], rows: [row, row + rows] }
}

fn highest(left: &[bool], width: usize, row: usize, column: usize) -> Rectangle {
    let is_set = |row: &usize| left.get(row * width + column).copied().unwrap_or_default();
    let rows = (row..left.len() / width).take_while(is_set).count();
    let run = (row..row + rows).map(|row| run_of(left, width, row, column)).min().unwrap_or_default();
    Rectangle { columns: [column, column + run], rows: [row, row + rows] }
}

/// Number of occupied cells from one on to the right.
fn run_of(left: &[bool], width: usize, row: usize, column: usize) -> usize {
    let cells = left.get(row * width + column..(row + 1) * width);
    cells.map_or(0, |cells| cells.iter().take_while(|is| **is).count())
}

#[cfg(test)]
mod tests {
    use super::cover;

    #[test]
    fn cover_takes_each_occupied_cell_once() {
        // A reproducible pattern of every density.
        let mut seed = 7_u32;
        for width in 1..12 {
            for height in 1..12 {
                for density in [1, 3, 5, 7, 8] {
                    let cells: Vec<bool> = (0..width * height)
                        .map(|_| {
                            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                            (seed >> 24) % 8 < density
                        })
                        .collect();
                    let mut times = vec![0; cells.len()];
                    let found = cover(&cells, width);
                    for it in &found {
                        for row in it.rows[0]..it.rows[1] {
                            (it.columns[0]..it.columns[1])
                                .for_each(|column| times[row * width + column] += 1);
                        }
                    }
                    let expected: Vec<_> = cells.iter().map(|is| i32::from(*is)).collect();
                    assert_eq!(times, expected);
                    if density == 8 {
                        assert_eq!(found.len(), 1, "a full map is one rectangle");
                    }
                }
            }
        }
    }
}
