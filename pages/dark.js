"use strict";
// Colours of figures and keys on a dark ground: their lightness is turned round, so that what was dark on white is light on black, in its hue.
// White is the ground of a dark card; greys come out lighter than mirrored, for a line is thin.
const DARKEST = 0.12, LIGHTEST = 0.92, LIFTED = 0.7;

function turned(red, green, blue) {
  const [r, g, b] = [red / 255, green / 255, blue / 255];
  const most = Math.max(r, g, b), least = Math.min(r, g, b), light = (most + least) / 2, chroma = most - least;
  const full = 1 - Math.abs(2 * light - 1);
  const to = DARKEST + (LIGHTEST - DARKEST) * (1 - light) ** LIFTED;
  // As strong a colour as it was, where the new lightness has room for it.
  const strength = (full ? chroma / full : 0) * (1 - Math.abs(2 * to - 1));
  return [r, g, b].map((part) => Math.round(255 * (to + (chroma ? ((part - light) / chroma) * strength : 0))));
}

const two = (part) => Math.min(Math.max(part, 0), 255).toString(16).padStart(2, "0");
const onDark = (text) =>
  text
    .replace(/#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})\b/gi, (_, ...parts) => "#" + turned(...parts.slice(0, 3).map((p) => parseInt(p, 16))).map(two).join(""))
    .replace(/rgba\((\d+), ?(\d+), ?(\d+), ?([\d.]+)\)/g, (_, r, g, b, a) => `rgba(${turned(+r, +g, +b).map((p) => Math.min(Math.max(p, 0), 255)).join(",")},${a})`);

// Content of figures, as it is for paper or for a dark screen.
const painted = (content, dark) => JSON.parse(dark ? onDark(JSON.stringify(content)) : JSON.stringify(content));

// Keys and cards that carry their colour themselves.
const CARRIED = ["style", "stroke", "fill"];
const carriers = [...document.querySelectorAll("header, main")].flatMap((part) =>
  [...part.querySelectorAll("*")].flatMap((place) =>
    CARRIED.filter((name) => place.getAttribute(name)?.includes("#")).map((name) => ({ place, name, text: place.getAttribute(name) })),
  ),
);
function paintKeys(dark) {
  for (const { place, name, text } of carriers) place.setAttribute(name, dark ? onDark(text) : text);
}
