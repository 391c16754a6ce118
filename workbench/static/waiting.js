// One thing is computed at a time: what was asked for meanwhile waits for its end, the last of several.

// Another tab, or a click before this one, was first.
const TAKEN = 409;

// ``busy()``: whether something is computed; ``begin(work)`` asks the server for it; ``changed()``: what waits is another thing now.
export function waiting({ busy, act, begin, changed }) {
  const queue = {
    next: null,
    start: (work) => inTurn(() => attempt(work)),
    heard: () => {
      if (!queue.next || busy()) return;
      const work = queue.next;
      queue.next = null;
      queue.start(work);
    },
    leave: () => wait(null),
  };
  // What a click before it began is known only once that was answered.
  let turn = Promise.resolve();
  const inTurn = (next) => {
    turn = turn.then(next, next);
    return turn;
  };
  const wait = (work) => {
    queue.next = work;
    changed();
  };
  const attempt = (work) =>
    busy()
      ? wait(work)
      : act(
          begin(work).catch((fault) => {
            if (fault.status !== TAKEN) throw fault;
            wait(work);
          }),
        );
  return queue;
}
