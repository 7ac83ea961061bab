/** Least squares and null spaces by Householder's reflections, singular values by Jacobi's rotations. That is all. */

const DEPENDENT = 1e-9; // share of the largest pivot below which a row adds nothing

/** The x (n numbers) that makes |A x - b|^2 + (damping |x|)^2 least, of m rows. With little damping this is the least-squares
 * solution of smallest length: redundant rows and free motions do no harm. */
export function leastSquares(matrix, right, damping) {
  const m = matrix.length;
  const n = matrix[0].length;
  const rows = m + n;
  // columns in one piece: the matrix over `damping` times the identity, then the right side over zeros
  const work = Array.from({ length: n + 1 }, () => new Float64Array(rows));
  for (let i = 0; i < m; i++) {
    for (let j = 0; j < n; j++) work[j][i] = matrix[i][j];
    work[n][i] = right[i];
  }
  for (let j = 0; j < n; j++) work[j][m + j] = damping;
  for (let k = 0; k < n; k++) reflect(work, k, Math.min(rows, m + k + 1));
  const x = new Float64Array(n);
  for (let k = n - 1; k >= 0; k--) {
    let sum = work[n][k];
    for (let j = k + 1; j < n; j++) sum -= work[j][k] * x[j];
    x[k] = work[k][k] === 0 ? 0 : sum / work[k][k];
  }
  return x;
}

/** Makes column k zero below its diagonal by a reflection; below `end` the column is zero already. */
function reflect(work, k, end) {
  const column = work[k];
  let size = 0;
  for (let i = k; i < end; i++) size += column[i] * column[i];
  size = Math.sqrt(size);
  if (size === 0) return;
  const top = column[k] > 0 ? column[k] + size : column[k] - size;
  const diagonal = column[k] > 0 ? -size : size;
  column[k] = top;
  const half = size * Math.abs(top);
  for (let j = k + 1; j < work.length; j++) {
    const other = work[j];
    let sum = 0;
    for (let i = k; i < end; i++) sum += column[i] * other[i];
    if (sum === 0) continue;
    sum /= half;
    for (let i = k; i < end; i++) other[i] -= sum * column[i];
  }
  column.fill(0, k, end);
  column[k] = diagonal;
}

/** An orthonormal basis, n - rank vectors of n numbers, of what a matrix of m rows takes to zero: by reflections of its
 * transpose, the longest column first. */
export function nullSpace(matrix, n) {
  const m = matrix.length;
  // the rows of the matrix, then the rows of an identity, which become the basis
  const work = [...matrix.map((row) => Float64Array.from(row)), ...Array.from({ length: n }, (_, i) => unit(n, i))];
  let rank = 0;
  let first = 0;
  for (; rank < Math.min(m, n); rank++) {
    const left = work.slice(rank, m).map((row) => norm(row.subarray(rank)));
    const pivot = left.reduce((best, size, i) => (size > left[best] ? i : best), 0);
    first ||= left[pivot];
    if (!(left[pivot] > DEPENDENT * first)) break;
    [work[rank], work[rank + pivot]] = [work[rank + pivot], work[rank]];
    reflect(work, rank, n);
  }
  return transposed(work.slice(m), n).slice(rank);
}

/** The i-th unit vector of n numbers. */
const unit = (n, i) => Float64Array.from({ length: n }, (_, k) => Number(k === i));

/** The n columns of a matrix. */
const transposed = (matrix, n) => Array.from({ length: n }, (_, j) => new Float64Array(matrix.map((row) => row[j])));

/** The n singular values of m rows, largest first, with their left and right vectors (one-sided Jacobi); left ones of value
 * 0 are 0. */
export function singular(matrix) {
  const n = matrix[0].length;
  const columns = transposed(matrix, n);
  const right = Array.from({ length: n }, (_, j) => unit(n, j));
  for (let sweep = 0; sweep < 40; sweep++) {
    let moved = false;
    for (let p = 0; p < n - 1; p++) for (let q = p + 1; q < n; q++) moved = rotated(columns, right, p, q) || moved;
    if (!moved) break;
  }
  const sizes = columns.map(norm);
  const order = sizes.map((_, k) => k).sort((a, b) => sizes[b] - sizes[a]);
  return {
    values: order.map((k) => sizes[k]),
    left: order.map((k) => columns[k].map((value) => (sizes[k] > 0 ? value / sizes[k] : 0))),
    right: order.map((k) => right[k]),
  };
}

/** Makes two columns orthogonal; whether that changed anything. */
function rotated(columns, right, p, q) {
  const a = dot(columns[p], columns[p]);
  const b = dot(columns[q], columns[q]);
  const c = dot(columns[p], columns[q]);
  if (Math.abs(c) <= 1e-15 * Math.sqrt(a * b) || c === 0) return false;
  const zeta = (b - a) / (2 * c);
  const t = (zeta >= 0 ? 1 : -1) / (Math.abs(zeta) + Math.hypot(1, zeta));
  const cosine = 1 / Math.hypot(1, t);
  turn(columns[p], columns[q], cosine, cosine * t);
  turn(right[p], right[q], cosine, cosine * t);
  return true;
}

function turn(first, second, cosine, sine) {
  for (let i = 0; i < first.length; i++) {
    const value = first[i];
    first[i] = cosine * value - sine * second[i];
    second[i] = sine * value + cosine * second[i];
  }
}

export function dot(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; i++) sum += a[i] * b[i];
  return sum;
}

const norm = (a) => Math.sqrt(dot(a, a));

/** Determinant of a square matrix: every reflection turns its sign. @param {number[][]} matrix @returns {number} */
export function determinant(matrix) {
  const work = matrix.map((row) => new Float64Array(row));
  work.forEach((_, k) => reflect(work, k, work.length));
  return work.reduce((product, column, k) => -product * column[k], 1);
}
