import assert from "node:assert/strict";
import { test } from "node:test";
import { determinant, leastSquares, nullSpace, singular } from "../src/solver/leastsquares.js";
import { apart } from "./numbers.js";

test("redundant rows do no harm, and of many solutions the shortest is found", () => {
  const x = leastSquares(
    [
      [1, 1, 0],
      [2, 2, 0],
      [0, 0, 3],
    ],
    [2, 4, 6],
    1e-10,
  );
  assert.ok(apart([...x], [1, 1, 2]) < 1e-9);
});

test("what contradicts itself is met half way", () => {
  const x = leastSquares([[1], [1]], [0, 1], 1e-12);
  assert.ok(Math.abs(x[0] - 0.5) < 1e-12);
});

test("singular values and vectors make the matrix again", () => {
  const matrix = [
    [3, 1, 0.5],
    [-1, 2, 0],
    [0.2, 0, 1e-3],
    [4, 4, 4],
  ];
  const { values, left, right } = singular(matrix);
  assert.ok(values[0] >= values[1] && values[1] >= values[2]);
  matrix.forEach((row, i) =>
    row.forEach((value, j) => {
      const made = values.reduce((sum, size, k) => sum + size * left[k][i] * right[k][j], 0);
      assert.ok(Math.abs(made - value) < 1e-13);
    }),
  );
});

test("a rank that is lacking is a singular value of rounding", () => {
  assert.ok(
    singular([
      [1, 2],
      [2, 4],
      [3, 6],
    ]).values[1] < 1e-15,
  );
});

test("determinants", () => {
  assert.equal(
    determinant([
      [0, 1],
      [1, 0],
    ]),
    -1,
  );
  assert.ok(
    Math.abs(
      determinant([
        [2, 1, 0],
        [1, 3, 1],
        [0, 1, 4],
      ]) - 18,
    ) < 1e-12,
  );
});

test("a null space is orthonormal, taken to zero and as large as the rank leaves it", () => {
  const matrix = [
    [1, 2, 0, -1, 3],
    [2, 4, 0, -2, 6],
    [0, 1, 1, 0.5, 0],
    [1, 3, 1, -0.5, 3],
  ];
  const basis = nullSpace(matrix, 5);
  assert.equal(basis.length, 3);
  const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
  basis.forEach((first, i) => {
    for (const row of matrix) assert.ok(Math.abs(dot(first, row)) < 1e-14);
    basis.forEach((second, j) => assert.ok(Math.abs(dot(first, second) - (i === j ? 1 : 0)) < 1e-14));
  });
  assert.equal(nullSpace([], 2).length, 2);
  assert.equal(nullSpace([[0, 0]], 2).length, 2);
});
