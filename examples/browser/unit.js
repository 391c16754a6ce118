// The unit's module as an importer of FMI 3.0 sees it: strings and lists go through its memory.
class Unit {
  // module: WebAssembly.Module; heard(text): where its messages go.
  constructor(module, facts, heard) {
    this.memory = new WebAssembly.Memory({ initial: facts.pages });
    const host = {
      env: { memory: this.memory },
      callbacks: { "log-message": (name, length, status, category, categoryLength, text, textLength) => heard(this.text(text, textLength)) },
    };
    this.calls = new WebAssembly.Instance(module, host).exports;
    this.calls._initialize();
    const name = this.bytes(new TextEncoder().encode("reducer")), token = this.bytes(new TextEncoder().encode(facts.token));
    // Memory may have moved after every call: it is looked at only then.
    const place = this.calls.instantiate(...name, ...token, 0, 0, 0, 1, 0, 0, 0, 0), answer = new DataView(this.memory.buffer, place, 8);
    if (!answer.getUint8(0)) throw new Error("the unit could not be made");
    this.held = answer.getUint32(4, true);
    this.calls.after_call(0);
    this.header = facts.header;
  }

  text(place, length) {
    return new TextDecoder().decode(new Uint8Array(this.memory.buffer, place, length));
  }

  // [address, count] of a typed array's copy in the unit's memory, until the call is over.
  bytes(array) {
    const place = this.calls.cabi_realloc(0, 0, 8, array.byteLength);
    new Uint8Array(this.memory.buffer, place, array.byteLength).set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    return [place, array.length];
  }

  method(name, ...given) {
    return this.calls["[method]co-simulation-instance." + name](this.held, ...given);
  }

  // A call whose result is a list, or a status above warning.
  list(name, kind, ...given) {
    const place = this.method(name, ...given), answer = new DataView(this.memory.buffer, place, 12);
    const found = answer.getUint8(0) ? null : new kind(this.memory.buffer, answer.getUint32(4, true), answer.getUint32(8, true)).slice();
    this.calls.after_call(0);
    return found;
  }

  get(references) {
    return this.list("get-float64", Float64Array, ...this.bytes(Uint32Array.from(references)));
  }

  set(reference, value) {
    const status = this.method("set-float64", ...this.bytes(Uint32Array.of(reference)), ...this.bytes(Float64Array.of(value)));
    this.calls.after_call(0);
    return status < 2;
  }

  initialise() {
    return this.method("enter-initialization-mode", 0, 0.0, 0.0, 0, 0.0) < 2 && this.method("exit-initialization-mode") < 2;
  }

  step(time, duration) {
    const place = this.method("do-step", time, duration, 1), went = new Uint8Array(this.memory.buffer, place, 1)[0] === 0;
    this.calls.after_call(0);
    return went;
  }

  // The cells of the complete state.
  state() {
    const bytes = this.list("get-fmu-state", Uint8Array);
    return new Float64Array(bytes.buffer, this.header);
  }

  free() {
    this.calls.drop(this.held);
  }
}
