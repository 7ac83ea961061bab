import assert from "node:assert/strict";
import { test } from "node:test";
import { coursesOf, followedCourse, onCourse } from "../src/courses.js";
import { Mechanism } from "../src/mechanism.js";
import { toPose } from "../src/solver/motion.js";
import { MECHANISMS, mechanism } from "./numbers.js";

const made = (name) => new Mechanism(mechanism(name).scene);
const DEGREE = 180 / Math.PI;

test("a course says its size, and is of that size", () => {
  const it = made("zeng2019");
  const courses = coursesOf(it);
  const circle = courses.find(({ name }) => name(1) === "circle in y and z, radius 1 mm");
  const found = followedCourse(it, circle);
  const poses = found.samples.map((_, k) => onCourse(it, circle, found, k / 60)).map(({ values }) => {
    it.values = values;
    return it.pose;
  });
  const middle = [0, 1, 2].map((k) => poses.slice(1).reduce((sum, pose) => sum + pose[k] / 60, 0));
  for (const pose of poses) {
    const radius = Math.hypot(pose[1] - middle[1], pose[2] - middle[2]);
    assert.ok(Math.abs(radius - found.size) < 1e-6 * found.size);
    assert.ok(Math.abs(pose[0] - poses[0][0]) < 1e-6);
  }
  it.reset();
  const y = courses.find(({ name }) => name(200) === "y to and fro, 200 mm");
  const swung = followedCourse(it, y);
  const along = swung.samples.map((_, k) => y.at(k / 60, swung.size, swung.way)[1]);
  assert.ok(Math.abs(Math.max(...along) - Math.min(...along) - swung.size) < 1e-3 * swung.size);
});

test("the widest circle comes first, and every plane has one", () => {
  const names = coursesOf(made("zeng2019")).map(({ name, sizes }) => name(sizes[0]));
  assert.deepEqual(names.slice(0, 3), [
    "circle in y and z, radius 50 mm",
    "circle in x and y, radius 20 mm",
    "circle in x and z, radius 20 mm",
  ]);
});

for (const { name, scene } of MECHANISMS)
  test(`${name}: a course from home stays on the sliders, closes, and has a round size`, () => {
    const it = new Mechanism(scene);
    const [course] = coursesOf(it);
    const found = followedCourse(it, course);
    assert.ok(found.samples, found.reason?.text);
    assert.ok(it.same(found.samples[0], found.samples.at(-1))); // rods with ball joints may have spun
    assert.match(course.name(found.size), /^circle in \S+ and \S+, radius (0\.0*)?[125]0*(\.0)?(°| \S+)$/);
    found.samples.forEach((_, k) => {
      const target = course.at(k / 60, found.size, found.way);
      scene.poseRange.forEach(([low, high], j) => assert.ok(target[j] > low - 1e-9 && target[j] < high + 1e-9));
    });
  });

test("a course keeps away from limits: one a quarter larger would fit too", () => {
  const it = made("zeng2019");
  const [circle] = coursesOf(it);
  const [largest] = circle.sizes;
  assert.equal(followedCourse(it, circle).size, largest);
  const inputs = [0, 1, 2, 3].flatMap((way) => {
    let { values } = it;
    return Array.from({ length: 61 }, (_, k) => {
      ({ values } = toPose(it.model, values, circle.at(k / 60, 1.02 * largest, way), {}));
      return values;
    });
  });
  it.model.inputs.forEach((item) => {
    const values = inputs.map((joints) => item.sign * joints[item.index] + item.offset);
    item.stroke = [Math.min(...values), Math.max(...values)];
  });
  assert.equal(onCourse(it, circle, { size: largest, way: 0, samples: Array(61).fill(it.values) }, 0.5).status, "moved");
  assert.ok(followedCourse(it, circle).size < largest);
});

test("a course that cannot be followed says why", () => {
  const it = made("zeng2019");
  it.model.inputs.forEach((item, k) => (item.stroke = [it.inputs[k] - 1e-6, it.inputs[k] + 1e-6]));
  const found = followedCourse(it, coursesOf(it)[0]);
  assert.equal(found.samples, undefined);
  assert.equal(found.reason.kind, "stroke");
  assert.match(found.reason.text, /^stroke of yA\d ends here/);
});

test("angles turn by round numbers of degrees", () => {
  const it = made("planar_3rrr");
  const phi = coursesOf(it).find(({ name }) => name(1).startsWith("φ"));
  for (const size of phi.sizes) {
    const [first] = (size * DEGREE).toPrecision(3);
    assert.ok("125".includes(first));
  }
});
