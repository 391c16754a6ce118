// One thing is computed at a time: what was asked for meanwhile waits for its end; of several the last, and each that stands for itself.

// Another tab, or a click before this one, was first.
const TAKEN = 409;

// ``busy()``: whether something is computed; ``begin(work)`` asks the server for it; ``changed()``: what waits is another thing now;
// ``apart(work)``: whether it stands for itself, and takes no other's place.
export function waiting({ busy, act, begin, changed, apart = () => false }) {
  const queue = {
    waits: [],
    start: (work) => inTurn(() => attempt(work)),
    heard: () => {
      if (!queue.waits.length || busy()) return;
      const [work, ...rest] = queue.waits;
      queue.waits = rest;
      queue.start(work);
    },
    leave: (work) => set(queue.waits.filter((other) => other !== work)),
  };
  // What a click before it began is known only once that was answered.
  let turn = Promise.resolve();
  const inTurn = (next) => {
    turn = turn.then(next, next);
    return turn;
  };
  const set = (waits) => {
    queue.waits = waits;
    changed();
  };
  // With what stands for itself, once; of the others with the last.
  const others = (work) => (apart(work) ? queue.waits : queue.waits.filter(apart));
  const waits = (work) => queue.waits.some((other) => apart(other) && JSON.stringify(other) === JSON.stringify(work));
  const attempt = (work) =>
    busy()
      ? set(waits(work) ? queue.waits : [...others(work), work])
      : act(
          begin(work).catch((fault) => {
            if (fault.status === TAKEN) {
              set(waits(work) ? queue.waits : [work, ...others(work)]);
              return;
            }
            // What cannot be begun keeps nobody waiting.
            setTimeout(queue.heard, 0);
            throw fault;
          }),
        );
  return queue;
}
