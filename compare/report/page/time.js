// When the steps of a scene begin.

/// @param dt       length of every step [s], unless
/// @param lengths  gives each its own, from the front again when it is through.
class StepTimes {
  constructor(dt, lengths = []) {
    this.lengths = lengths.length ? lengths : [dt > 0 ? dt : 1 / 60];
    this.begins = [0];
    for (const length of this.lengths) this.begins.push(this.begins[this.begins.length - 1] + length);
    this.round = this.begins.pop();
  }

  /// Seconds from the start of the scene.
  at(step, fraction = 0) {
    const count = this.lengths.length, inRound = step % count;
    return Math.floor(step / count) * this.round + this.begins[inRound] + fraction * this.lengths[inRound];
  }

  /// The step that is going on after so many seconds, and the fraction of it that is over.
  stepAt(seconds) {
    const rounds = Math.floor(seconds / this.round), rest = Math.max(0, seconds - rounds * this.round);
    const low = this.begins.findLastIndex((begin) => begin <= rest);
    const fraction = Math.min(1, (rest - this.begins[low]) / this.lengths[low]);
    return {step: rounds * this.lengths.length + low, fraction};
  }

  inWords() {
    const shortest = measure(Math.min(...this.lengths)), longest = measure(Math.max(...this.lengths));
    return shortest === longest ? `dt ${longest} s` : `dt ${shortest} to ${longest} s`;
  }

  /// On average [s].
  get mean() {
    return this.round / this.lengths.length;
  }
}
