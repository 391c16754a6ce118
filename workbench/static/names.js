// Names that stand beside each other.

// Without the words at their beginning and end that all of them share; as they are where that leaves nothing of one.
export function distinct(names) {
  if (names.length < 2) return names;
  const parted = names.map((name) => name.match(/[^_ ,-]+[_ ,-]*/g) ?? [name]),
    least = Math.min(...parted.map((words) => words.length)),
    alike = (at) => parted.every((words) => words.at(at) === parted[0].at(at));
  let first = 0,
    last = 0;
  while (first < least && alike(first)) first++;
  while (last < least - first && alike(-1 - last)) last++;
  if (first + last >= least) return names;
  return parted.map((words) => `${first ? "…" : ""}${words.slice(first, words.length - last).join("").replace(/[_ ,-]+$/, "")}${last ? "…" : ""}`);
}
