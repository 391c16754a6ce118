// The drawing: housing, pins, discs, cranks, forces, wear; lengths in mm.
class Picture {
  constructor(canvas, facts) {
    this.canvas = canvas;
    this.facts = facts;
    this.reach = facts.pinCircle + 4.2 * facts.pinRadius;
    this.outline = this.disc(null, 0);
    this.colours();
  }

  colours() {
    const style = getComputedStyle(document.documentElement);
    this.colour = (name) => style.getPropertyValue("--" + name).trim();
  }

  // The flank of a disc, each point moved inwards by depth(point) times gain [mm].
  disc(depth, gain) {
    const path = new Path2D(), { flank, lobes, fine } = this.facts;
    for (let lobe = 0; lobe < lobes; lobe++) {
      const turn = 2 * Math.PI * lobe / lobes, c = Math.cos(turn), s = Math.sin(turn);
      for (let k = 0; k < fine; k++) {
        const [x, y, nx, ny] = flank[k], in_ = depth ? gain * depth[lobe * fine + k] : 0;
        const px = x - in_ * nx, py = y - in_ * ny;
        path.lineTo(c * px - s * py, s * px + c * py);
      }
    }
    path.closePath();
    return path;
  }

  // Depths [m] of the front disc, one for each bin of its surface; drawn so much larger that they show.
  wear(bins) {
    const { lobes, fine } = this.facts, step = bins.length / (lobes * fine), depth = new Float64Array(lobes * fine);
    let deepest = 0;
    for (let i = 0; i < depth.length; i++) {
      depth[i] = 1e3 * bins[Math.floor((i + 0.5) * step)];
      deepest = Math.max(deepest, depth[i]);
    }
    this.gain = deepest > 1e-7 ? Math.min(20000, roundDown(0.55 * this.facts.pinRadius / deepest)) : 0;
    this.worn = this.gain ? this.disc(depth, this.gain) : null;
  }

  draw(crankAngle, outputAngle, forces, longest) {
    const { canvas, facts } = this, ratio = window.devicePixelRatio || 1;
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const pen = canvas.getContext("2d"), size = Math.min(width, height) / 2 / this.reach;
    pen.setTransform(size, 0, 0, -size, width / 2, height / 2);
    pen.clearRect(-this.reach * 4, -this.reach * 4, this.reach * 8, this.reach * 8);
    const fine = 1.2 * ratio / size;
    pen.lineWidth = fine;
    this.circle(pen, 0, 0, this.reach * 0.995, this.colour("ring"), this.colour("steel"));
    this.circle(pen, 0, 0, facts.pinCircle + 0.25 * facts.pinRadius, this.colour("paper"), null);
    const places = [];
    for (let d = facts.discs - 1; d >= 0; d--) {
      const eccentric = crankAngle + 2 * Math.PI * d / facts.discs;
      const place = { x: facts.eccentricity * Math.cos(eccentric), y: facts.eccentricity * Math.sin(eccentric), eccentric };
      places[d] = place;
      pen.save();
      pen.translate(place.x, place.y);
      pen.rotate(outputAngle - 2 * Math.PI * d / facts.discs / facts.lobes);
      pen.globalAlpha = d ? 1 : 0.82;
      pen.fillStyle = this.colour(d ? "face1" : "face0");
      pen.strokeStyle = this.colour(d ? "disc1" : "disc0");
      pen.fill(this.outline);
      pen.globalAlpha = 1;
      if (d === 0 && this.worn) {
        const band = new Path2D(this.outline);
        band.addPath(this.worn);
        pen.fillStyle = this.colour("worn");
        pen.fill(band, "evenodd");
      }
      pen.stroke(this.outline);
      pen.restore();
    }
    this.cranks(pen, crankAngle, outputAngle, places);
    this.pins(pen, forces, longest);
    this.forces(pen, places, forces, longest, 2.6 * fine);
  }

  circle(pen, x, y, radius, fill, stroke) {
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    if (fill) { pen.fillStyle = fill; pen.fill(); }
    if (stroke) { pen.strokeStyle = stroke; pen.stroke(); }
  }

  // Front disc: hole, rollers, the crank's eccentric, and a mark that turns with it.
  cranks(pen, crankAngle, outputAngle, places) {
    const { facts } = this, steel = this.colour("steel");
    for (let c = 0; c < facts.cranks; c++) {
      const at = outputAngle + 2 * Math.PI * c / facts.cranks;
      const seat = [facts.crankCircle * Math.cos(at), facts.crankCircle * Math.sin(at)];
      const x = seat[0] + places[0].x, y = seat[1] + places[0].y;
      this.circle(pen, x, y, facts.outerRace, this.colour("paper"), this.colour("disc0"));
      const rollers = Math.max(3, Math.round(Math.PI * (facts.innerRace + facts.rollerRadius) / (1.15 * facts.rollerRadius)));
      for (let k = 0; k < rollers; k++) {
        const turn = crankAngle * 0.4 + 2 * Math.PI * k / rollers, away = facts.innerRace + facts.rollerRadius;
        this.circle(pen, x + away * Math.cos(turn), y + away * Math.sin(turn), 0.92 * facts.rollerRadius, this.colour("crank"), steel);
      }
      this.circle(pen, x, y, facts.innerRace, this.colour("crank"), steel);
      this.circle(pen, ...seat, 0.55 * facts.innerRace, this.colour("ring"), steel);
      pen.beginPath();
      pen.moveTo(...seat);
      pen.lineTo(seat[0] + 0.9 * facts.innerRace * Math.cos(crankAngle), seat[1] + 0.9 * facts.innerRace * Math.sin(crankAngle));
      pen.stroke();
    }
  }

  pins(pen, forces, longest) {
    const { facts } = this, steel = this.colour("steel"), colours = [this.colour("disc0"), this.colour("disc1")];
    for (let j = 0; j < facts.pins; j++) {
      const at = 2 * Math.PI * j / facts.pins, x = facts.pinCircle * Math.cos(at), y = facts.pinCircle * Math.sin(at);
      this.circle(pen, x, y, facts.pinRadius, this.colour("pin"), steel);
      for (let d = 0; d < facts.discs; d++) {
        const share = Math.min(1, forces[d * facts.pins + j] / longest);
        if (share > 0) {
          pen.globalAlpha = share;
          this.circle(pen, x, y, facts.pinRadius, colours[d % 2], null);
          pen.globalAlpha = 1;
        }
      }
    }
  }

  // All normals of a disc's contacts meet in its pitch point; a force pushes the disc along its own.
  forces(pen, places, forces, longest, thick) {
    const { facts } = this, pitch = facts.eccentricity * facts.pins;
    for (let d = facts.discs - 1; d >= 0; d--) {
      const px = pitch * Math.cos(places[d].eccentric), py = pitch * Math.sin(places[d].eccentric);
      pen.strokeStyle = pen.fillStyle = this.colour(d % 2 ? "disc1" : "disc0");
      for (let j = 0; j < facts.pins; j++) {
        const force = forces[d * facts.pins + j];
        if (!(force > 0)) continue;
        const at = 2 * Math.PI * j / facts.pins, x = facts.pinCircle * Math.cos(at), y = facts.pinCircle * Math.sin(at);
        const away = Math.hypot(px - x, py - y), ux = (px - x) / away, uy = (py - y) / away;
        const length = 0.34 * facts.pinCircle * Math.min(1.2, force / longest), start = facts.pinRadius;
        const tip = start + length, head = Math.min(3.2 * thick, 0.5 * length);
        pen.lineWidth = thick;
        pen.beginPath();
        pen.moveTo(x + start * ux, y + start * uy);
        pen.lineTo(x + (tip - 0.8 * head) * ux, y + (tip - 0.8 * head) * uy);
        pen.stroke();
        pen.beginPath();
        pen.moveTo(x + tip * ux, y + tip * uy);
        pen.lineTo(x + (tip - head) * ux - 0.5 * head * uy, y + (tip - head) * uy + 0.5 * head * ux);
        pen.lineTo(x + (tip - head) * ux + 0.5 * head * uy, y + (tip - head) * uy - 0.5 * head * ux);
        pen.fill();
      }
    }
  }
}

function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  return power * [5, 2, 1].find((step) => step * power <= value * (1 + 1e-9));
}

// Depths over hours as two lines.
class History {
  constructor(canvas, picture) {
    [this.canvas, this.picture, this.points] = [canvas, picture, []];
  }

  // Hours, depth of flanks and of raceways [um]; kept where they show.
  add(hours, flank, race) {
    const last = this.points[this.points.length - 1];
    if (last && hours - last[0] < Math.max(1e-6, hours / 600)) return;
    this.points.push([hours, flank, race]);
  }

  draw() {
    const { canvas, points } = this, ratio = window.devicePixelRatio || 1, colour = this.picture.colour;
    [canvas.width, canvas.height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    const pen = canvas.getContext("2d"), left = 56, bottom = 24, width = canvas.clientWidth - left - 12, height = canvas.clientHeight - bottom - 10;
    pen.scale(ratio, ratio);
    pen.font = "12px system-ui, sans-serif";
    const last = points.length ? points[points.length - 1] : [0, 0, 0];
    const across = Math.max(roundUp(last[0]), 1), up = Math.max(roundUp(Math.max(...points.map((p) => Math.max(p[1], p[2])), 0)), 0.01);
    pen.strokeStyle = colour("line");
    pen.fillStyle = colour("quiet");
    for (let k = 0; k <= 4; k++) {
      const y = 10 + height * (1 - k / 4), x = left + width * k / 4;
      pen.beginPath();
      pen.moveTo(left, y);
      pen.lineTo(left + width, y);
      pen.stroke();
      pen.textAlign = "right";
      pen.fillText(plain(up * k / 4) + (k === 4 ? " \u00b5m" : ""), left - 6, y + 4);
      pen.textAlign = k === 4 ? "right" : k ? "center" : "left";
      pen.fillText(plain(across * k / 4) + (k === 4 ? " h" : ""), x, 10 + height + 18);
    }
    [[1, "worn"], [2, "race"]].forEach(([part, name]) => {
      pen.strokeStyle = colour(name);
      pen.lineWidth = 2;
      pen.beginPath();
      points.forEach((p) => pen.lineTo(left + width * p[0] / across, 10 + height * (1 - p[part] / up)));
      pen.stroke();
    });
  }
}

function roundUp(value) {
  if (!(value > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 4, 6, 8, 10].find((step) => step * power >= value * (1 - 1e-9));
}

function plain(value) {
  return value === 0 ? "0" : value >= 1000 ? Math.round(value).toLocaleString("en") : String(Number(value.toPrecision(3)));
}
