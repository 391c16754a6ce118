// The page: sliders to inputs, time to steps, results to the screen.
const facts = JSON.parse(document.getElementById("facts").textContent);
const part = (id) => document.getElementById(id);
const binary = Uint8Array.from(atob(part("wasm").textContent), (sign) => sign.charCodeAt(0));
const module_ = new WebAssembly.Module(binary);
const ARCSEC = 180 * 3600 / Math.PI;
// Seconds of operation that a second stands for: none, then hours.
const LAPSES = [1, 600, 3600, 5 * 3600, 25 * 3600, 100 * 3600, 250 * 3600];
const picture = new Picture(part("picture"), facts), history_ = new History(part("history"), picture);
let unit, time, runs = true, slow = false, last = null, spent = 0, done = 0, frames = 0;

function made() {
  const one = new Unit(module_, facts, (text) => { part("message").textContent = text; });
  return one.initialise() ? one : null;
}

function anew() {
  if (unit) unit.free();
  part("message").textContent = "";
  [unit, time, picture.worn, picture.gain, history_.points] = [made(), 0, null, 0, [[0, 0, 0]]];
  put();
}

function inputs() {
  return { torque: Number(part("torque").value), rpm: Number(part("speed").value), lapse: LAPSES[Number(part("lapse").value)] };
}

function put() {
  const { torque, rpm, lapse } = inputs();
  // Without time lapse wear goes on at its own pace, as the hours do.
  unit.set(facts.set.torque, torque);
  unit.set(facts.set.speed, rpm * Math.PI / 30 * facts.ratio);
  unit.set(facts.set.acceleration, lapse);
  part("torqueShown").textContent = `${torque.toFixed(0)} N m`;
  part("speedShown").textContent = `${rpm.toFixed(1)} rpm`;
  part("lapseShown").textContent = lapse > 1 ? `1 s is ${duration(lapse)}` : "none";
}

function duration(seconds) {
  return seconds < 7200 ? `${plain(seconds / 60)} min` : `${plain(seconds / 3600)} h`;
}

function advance(passed) {
  const before = performance.now();
  if (!unit.step(time, passed)) {
    runs = false;
    part("run").textContent = "go on";
    return;
  }
  spent += (performance.now() - before) / 1000;
  done += passed;
  time += passed;
}

function look() {
  const names = Object.keys(facts.shown), values = unit.get(Object.values(facts.shown));
  const found = Object.fromEntries(names.map((name, k) => [name, values[k]]));
  const cells = unit.state(), [first, discs, pins] = facts.held.forces;
  const forces = cells.slice(first, first + discs * pins);
  if (frames % 12 === 0) {
    const [start, , bins] = facts.held.wear;
    picture.wear(cells.slice(start, start + bins));
    part("gain").textContent = picture.gain ? `wear of the front disc, ${plain(picture.gain)} times as deep` : "wear";
    history_.add(found.hours / 3600, found.flank * 1e6, found.race * 1e6);
    history_.draw();
    show(found, forces);
  }
  picture.draw(found.crankAngle, found.outputAngle, forces, scale(forces));
  frames += 1;
}

// Arrows have one scale until a force would be too long for it.
let longest = 100;
function scale(forces) {
  const most = forces.reduce((a, b) => Math.max(a, b), 0);
  if (most > longest || most < 0.3 * longest) longest = Math.max(50, roundUp(most));
  return longest;
}

function show(found, forces) {
  const loaded = forces.reduce((count, force) => count + (force > 0), 0) / facts.discs;
  const rows = [
    ["hours of operation", plain(found.hours / 3600), "h"], ["lag of the output", (found.lag * ARCSEC).toFixed(1), "arcsec"],
    ["transmission error", (found.transmissionError * ARCSEC).toFixed(1), "arcsec"], ["lost motion", (found.lostMotion * ARCSEC).toFixed(1), "arcsec"],
    ["largest pin force", found.pinForce.toFixed(0), "N"], ["largest roller force", found.rollerForce.toFixed(0), "N"],
    ["pins that carry, per disc", loaded.toFixed(1), ""],
    ["deepest wear of a flank", (found.flank * 1e6).toFixed(3), "\u00b5m"], ["deepest wear of a raceway", (found.race * 1e6).toFixed(3), "\u00b5m"],
    ["life left at this load", found.life > 0 && found.life < 1e12 ? plain(Number((found.life / 3600).toPrecision(2))) : "\u2013", "h"],
  ];
  part("figures").innerHTML = rows.map(([name, value, unit_]) => `<dt>${name}</dt><dd>${value} <small>${unit_}</small></dd>`).join("");
  part("scale").textContent = `longest arrow ${plain(longest)} N`;
}

// How many times faster than real time the unit is at rated speed and torque, all of a frame but the drawing; the best of
// some quarters of a second, because other pages share the machine.
function measured() {
  const one = made(), frame = 1 / 60;
  one.set(facts.set.torque, facts.rated.torque);
  one.set(facts.set.speed, facts.rated.rpm * Math.PI / 30 * facts.ratio);
  one.set(facts.set.acceleration, 1e5);
  const turn = (count, from) => { for (let k = 0; k < count; k++) { one.step((from + k) * frame, frame); one.get(Object.values(facts.shown)); one.state(); } };
  let best = 0;
  for (let window_ = 0; window_ < 4; window_++) {
    const before = performance.now();
    turn(15, 15 * window_);
    best = Math.max(best, 15 * frame / ((performance.now() - before) / 1000));
  }
  one.free();
  return best;
}

function frame(now) {
  const passed = last === null ? 1 / 60 : Math.min((now - last) / 1000, 0.1);
  last = now;
  if (runs && passed > 0) advance(slow ? passed / 20 : passed);
  look();
  if (done > 2) {
    part("now").textContent = `; at the speed set ${plain(Number((done / spent).toPrecision(2)))} times`;
    [done, spent] = [0, 0];
  }
  requestAnimationFrame(frame);
}

function begin() {
  const most = Math.ceil(facts.rated.torque * 1.5 / 10) * 10, fastest = Math.ceil(facts.rated.rpm * 2);
  Object.assign(part("torque"), { min: 0, max: most, step: 1, value: facts.rated.torque });
  Object.assign(part("speed"), { min: -fastest, max: fastest, step: 0.5, value: facts.rated.rpm });
  const factor = measured();
  part("factor").dataset.factor = factor;
  part("factor").textContent = `${plain(Number(factor.toPrecision(2)))} times real time`;
  anew();
  for (const id of ["torque", "speed", "lapse"]) part(id).addEventListener("input", put);
  part("anew").addEventListener("click", anew);
  part("run").addEventListener("click", () => { runs = !runs; part("run").textContent = runs ? "pause" : "go on"; });
  part("slow").addEventListener("click", () => { slow = !slow; part("slow").setAttribute("aria-pressed", slow); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => picture.colours());
  advance(1 / 60);
  look();
  document.body.dataset.state = "ready";
  requestAnimationFrame(frame);
}

begin();
