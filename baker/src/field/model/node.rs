//! Where the mesh of a node is.

use gltf::{Node, Semantic};

/// A matrix as glTF has it, column by column.
pub(super) type Matrix = [[f32; 4]; 4];

/// The corners of the box around the positions of a node's mesh.
pub(super) fn corners(node: &Node) -> Option<[[f32; 3]; 8]> {
    let mut bounds: Option<[[f32; 3]; 2]> = None;
    for primitive in node.mesh()?.primitives() {
        let positions = primitive.get(&Semantic::Positions)?;
        let low: [f32; 3] = serde_json::from_value(positions.min()?).ok()?;
        let high: [f32; 3] = serde_json::from_value(positions.max()?).ok()?;
        let [before_low, before_high] = bounds.unwrap_or([low, high]);
        let axes = [0, 1, 2];
        bounds = Some([
            axes.map(|axis| low[axis].min(before_low[axis])),
            axes.map(|axis| high[axis].max(before_high[axis])),
        ]);
    }
    let bounds = bounds?;
    let corner = |n: usize| [0, 1, 2].map(|axis| bounds[n >> axis & 1][axis]);
    Some([0, 1, 2, 3, 4, 5, 6, 7].map(corner))
}

pub(super) const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

pub(super) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    b.map(|column| {
        let row = |i: usize| (0..4).map(|k| a[k][i] * column[k]).sum();
        [row(0), row(1), row(2), row(3)]
    })
}

pub(super) fn transformed(matrix: &Matrix, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let row = |i: usize| matrix[0][i] * x + matrix[1][i] * y + matrix[2][i] * z + matrix[3][i];
    [row(0), row(1), row(2)]
}
