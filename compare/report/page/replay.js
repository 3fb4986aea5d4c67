// The replay: trajectories over the scenery, and one step at a time.

/// Of several characters the last so many steps are drawn: nobody could read more.
const RECENT = 30;

class Replay {
  constructor(data, names, onStep) {
    Object.assign(this, {data, names, onStep, playing: false, t: 1, at: 0, together: true, mode: 'fit'});
    this.focus = null;  // what the mode 'event' shows
    this.runs = data.runs.filter((run) => run.steps.length > 0);
    this.visible = new Set(this.runs);
    this.timeline = [...new Set(this.runs.flatMap((run) => run.steps.map((step) => step.step)))].sort((a, b) => a - b);
    this.speed = usualSpeed(this);
    this.show = {trajectories: true, start: true, velocity: true};
    this.camera = new Camera();
    this.views = [];
    this.build();
  }

  build() {
    this.box = el('div', {class: 'views'});
    this.readout =
        el('div', {class: 'readout table-box', tabindex: '0', role: 'region', 'aria-label': 'State at this step'});
    this.root =
        el('section', {'aria-label': 'Replay'}, el('h3', {}, 'Replay'), el('p', {class: 'quiet'}, keptInWords(this)),
           legend(this), cameraBar(this), this.box, transport(this), jumps(this), this.readout, traces(this),
           el('p', {class: 'quiet'},
              'Keys: space plays and pauses, left and right step, Home and End jump, + and \u2212 zoom, F follows. ' +
                  'The wheel zooms (with Ctrl held, or after a click into the picture), dragging moves the picture.'));
    this.makeViews();
  }

  // --- what is shown ---

  toggle(run) {
    const next = this.runs.filter((other) => this.visible.has(other) !== (other === run));
    this.setVisible(next);
  }
  setVisible(runs) {
    this.visible = new Set(runs);
    for (const run of this.runs) run.button.setAttribute('aria-pressed', String(this.visible.has(run)));
    this.makeViews();
    this.draw();
  }
  setTogether(together) {
    this.together = together;
    this.layoutButton.setAttribute('aria-pressed', String(!together));
    this.makeViews();
    this.look(this.mode);
  }

  chosen() {
    return this.runs.filter((run) => this.visible.has(run));
  }

  makeViews() {
    const chosen = this.chosen();
    const groups = this.together || chosen.length === 0 ? [chosen] : chosen.map((run) => [run]);
    this.box.classList.toggle('many', groups.length > 1);
    this.views = groups.map((runs) => this.makeView(runs, groups.length > 1));
    this.box.replaceChildren(...this.views.map((view) => view.element));
  }

  makeView(runs, labelled) {
    const canvas = el('canvas', {
      tabindex: '0',
      role: 'img',
      'aria-label': `Replay of ${runs.map((run) => run.label).join(', ') || 'no contender'}`
    });
    const label = labelled ?
        el('span', {class: 'label', style: `color:${inkOf(runs[0], this.names).colour}`}, runs[0].label) :
        null;
    const view = {runs, canvas, painter: new Painter(canvas), element: el('div', {class: 'view'}, canvas, label)};
    canvas.addEventListener('wheel', (event) => this.wheel(event, view), {passive: false});
    canvas.addEventListener('pointerdown', (event) => this.drag(event, canvas));
    return view;
  }

  // --- camera ---

  look(mode) {
    this.mode = mode;
    const canvas = this.views[0].canvas, width = canvas.clientWidth, height = canvas.clientHeight;
    const ways = nothing(), all = nothing();
    for (const run of this.runs) {
      const hull = boxOf(run.hull);
      for (const {steps} of run.characters)
        for (const {path} of steps)
          for (const corner of path) boxOf(movedBox(hull, corner), ways);
      boxOf(run.box.filter(Number.isFinite), all);
    }
    if (mode === 'event' && this.focus) this.camera.fit(this.focus.box, width, height, 0.1);
    if (mode === 'ways') this.camera.fit(ways, width, height, 0.1);
    if (mode === 'fit') this.camera.fit(boxOf(ways, all), width, height);
    if (mode === 'follow' && this.runs.length > 0) {
      const hull = boxOf(this.runs[0].hull);
      this.camera.scale = Math.min(width, height) / (9 * Math.max(hull[2] - hull[0], hull[3] - hull[1], 1e-12));
    }
    this.markMode();
    this.draw();
  }
  markMode() {
    for (const [mode, button] of this.modeButtons) button.setAttribute('aria-pressed', String(mode === this.mode));
  }

  /// The middle of the view: what is followed, or where the camera was put.
  cameraOf(view) {
    if (this.mode !== 'follow' || view.runs.length === 0) return this.camera;
    // The default contender, as all may go ways of their own.
    const followed = view.runs.find((run) => run.contender === 'octagon_sweep') || view.runs[0];
    const {x, y} = this.stateOf(followed).position;
    [this.camera.x, this.camera.y] = [x, y];
    return new Camera(x, y, this.camera.scale);
  }

  zoom(factor, x = this.camera.x, y = this.camera.y) {
    this.camera.zoom(factor, x, y);
    if (this.mode !== 'follow') {
      this.mode = 'free';
      this.markMode();
    }
    this.draw();
  }

  wheel(event, view) {
    if (!event.ctrlKey && document.activeElement !== view.canvas) return;
    event.preventDefault();
    const box = view.canvas.getBoundingClientRect();
    this.zoom(
        Math.exp(-event.deltaY * 0.0015), view.painter.worldX(event.clientX - box.left),
        view.painter.worldY(event.clientY - box.top));
  }

  drag(event, canvas) {
    canvas.setPointerCapture(event.pointerId);
    canvas.classList.add('dragging');
    let last = event;
    const move = (now) => {
      this.mode = 'free';
      this.markMode();
      this.camera.x -= (now.clientX - last.clientX) / this.camera.scale;
      this.camera.y += (now.clientY - last.clientY) / this.camera.scale;
      last = now;
      this.draw();
    };
    const stop = () => {
      canvas.classList.remove('dragging');
      canvas.removeEventListener('pointermove', move);
    };
    canvas.addEventListener('pointermove', move);
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, stop, {once: true});
  }

  // --- time ---

  get step() {
    return this.timeline[this.at];
  }
  seek(at, t = 1) {
    this.pause();
    this.at = Math.max(0, Math.min(this.timeline.length - 1, at));
    this.t = t;
    this.draw();
  }
  move(by) {
    this.seek(this.at + by);
  }
  goTo(step, t = 1) {
    let at = 0;
    while (at + 1 < this.timeline.length && this.timeline[at + 1] <= step) ++at;
    this.seek(at, t);
  }
  /// To a moment, with what matters then filling the view, and whoever else is near it.
  focusOn(focus) {
    this.goTo(focus.step, focus.t);
    this.focus = {...focus, box: withNeighbours(this, focus.box)};
    this.look('event');
  }
  jumpTo(focus) {
    this.focusOn(focus);
    this.root.scrollIntoView({block: 'start'});
  }

  togglePlay() {
    if (this.playing)
      this.pause();
    else
      this.play();
  }
  play() {
    if (this.at >= this.timeline.length - 1 && this.t >= 1) [this.at, this.t] = [0, 0];
    this.playing = true;
    this.playButton.textContent = 'Pause';
    this.playButton.setAttribute('aria-label', 'Pause');
    this.now = this.data.times.at(this.step, this.t);
    let last = null;
    const tick = (time) => {
      if (!this.playing) return;
      this.playOn(Math.min((time - (last ?? time)) / 1000, 0.25));
      last = time;
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
  /// Shows what is there so many seconds later, and stops at the end. Slow playback moves along the way within a step.
  playOn(seconds) {
    const {times} = this.data;
    this.now += seconds * this.speed;
    const {step, fraction} = times.stepAt(this.now);
    while (this.at + 1 < this.timeline.length && this.timeline[this.at + 1] <= step) ++this.at;
    // With a step or more per frame, a fraction of it would only flicker.
    this.t = step > this.step || this.speed / times.mean > 30 ? 1 : fraction;
    if (this.now >= times.at(this.timeline[this.timeline.length - 1] + 1)) {
      this.t = 1;
      this.pause();
    }
    this.draw();
  }
  pause() {
    this.playing = false;
    this.playButton.textContent = 'Play';
    this.playButton.setAttribute('aria-label', 'Play');
  }

  /// Keys count wherever the focus is, as long as the picture can be seen and the focus has no better use for them.
  key(event) {
    const box = this.box.getBoundingClientRect();
    const hidden = box.bottom < 40 || box.top > window.innerHeight - 40;
    if (hidden || event.defaultPrevented || event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.target.closest('.table-box, summary')) return;
    const inControl = ['INPUT', 'SELECT'].includes(event.target.tagName);
    const acts = {
      ArrowLeft: () => this.move(-1),
      ArrowRight: () => this.move(1),
      Home: () => this.seek(0),
      End: () => this.seek(this.timeline.length - 1),
      '+': () => this.zoom(1.4),
      '-': () => this.zoom(1 / 1.4),
      f: () => this.look(this.mode === 'follow' ? 'fit' : 'follow')
    };
    if (event.key === ' ' && event.target.tagName !== 'BUTTON' && event.target.type !== 'checkbox')
      acts[' '] = () => this.togglePlay();
    if (inControl && event.key !== ' ') return;
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  // --- drawing ---

  /// What a character does at the step that is shown: its record, the position within it, and whether it has ended
  /// before. A run is its first character. Where a game would draw it is `drawn`, if that is somewhere else.
  stateOf(character) {
    const index = Math.max(indexAt(character, this.step), 0), record = character.steps[index];
    const exact = record.step === this.step;
    const ended = !exact && index === character.steps.length - 1;
    const t = exact ? this.t : 1;
    return {index, record, ended, t, position: positionAt(record, t), drawn: drawnAt(character.steps, index, t)};
  }

  draw() {
    const colours = theme();
    for (const view of this.views) this.drawView(view, colours);
    this.slider.value = this.at;
    this.slider.setAttribute('aria-valuetext', `step ${this.step}`);
    this.within.value = this.t;
    const last = this.timeline[this.timeline.length - 1];
    this.clock.textContent = `step ${grouped(this.step)} of ${grouped(last)}, t = ${this.t.toFixed(3)}: ${
        this.data.times.at(this.step, this.t).toFixed(3)} s`;
    fillReadout(this);
    this.onStep(this);
  }

  drawView(view, colours) {
    const {painter, runs} = view;
    painter.begin(this.cameraOf(view), colours);
    const drawn = new Set();
    for (const run of runs.length ? runs : this.runs.slice(0, 1)) {
      if (drawn.has(run.scenery)) continue;
      drawn.add(run.scenery);
      const {record, t} = this.stateOf(run);
      painter.scenery(run.scenery, record, t);
    }
    if (this.show.trajectories)
      for (const run of runs) this.drawTrajectory(painter, run);
    for (const run of runs) this.drawRun(painter, run);
    painter.scaleBar();
  }

  drawTrajectory(painter, run) {
    const ink = inkOf(run, this.names), {index} = this.stateOf(run);
    const several = run.characters.length > 1;
    for (const {steps} of run.characters) {
      if (!several) painter.trajectory(steps, index, steps.length, {...ink, alpha: 0.25});
      painter.trajectory(steps, several ? index - RECENT : 0, index + 1, {...ink, alpha: several ? 0.4 : 0.8});
    }
    for (const event of run.events) {
      if (HARMLESS.includes(event.kind)) continue;
      const at = run.byStep.get(event.step);
      if (at === undefined || (several && (at > index || at < index - RECENT))) continue;
      const {x, y} = positionAt(run.characters[event.character].steps[at], 1);
      painter.cross(x, y);
    }
  }

  drawRun(painter, run) {
    run.characters.forEach((character, number) => this.drawCharacter(painter, run, character, number));
  }

  drawCharacter(painter, run, character, number) {
    const ink = inkOf(run, this.names), {record, ended, position, drawn} = this.stateOf(character);
    const [first] = record.path;
    if (!ended) {
      const world = this.stateOf(run);
      const highlight = (id, colour, dash) =>
          painter.highlight(placed(run.scenery.byId.get(id), world.record, world.t), colour, dash);
      for (const contact of record.contacts) highlight(contact.collider, ink.colour);
      for (const id of record.crush) highlight(id, painter.colours.bad);
      for (const id of record.drop) highlight(id, ink.colour, [3, 3]);
      if (this.show.start)
        painter.octagon(run.hull, first[0], first[1], {colour: ink.colour, dash: [2, 3], alpha: 0.5});
      painter.way(record.path, ink.colour, !run.path_exact);
    }
    painter.octagon(
        run.hull, position.x, position.y, {colour: ink.colour, fill: !ended, dash: ink.dash, alpha: ended ? 0.4 : 1});
    if (drawn && !ended) painter.octagon(run.hull, drawn.x, drawn.y, {colour: ink.colour, dash: [6, 3]});
    if (run.characters.length > 1) painter.number(number, position.x, position.y, ink.colour);
    if (ended) return;
    if (record.crush.length > 0) painter.cross(position.x, position.y);
    if (this.show.velocity) painter.velocity(position.x, position.y, record.velocity, ink.colour);
    record.contacts.forEach((contact) => painter.contact(contact, ink.colour));
    for (const {normal} of record.met) {
      const [x, y] = farthest(run.hull, -normal[0], -normal[1]);
      painter.contact({point: [position.x + x, position.y + y], normal}, ink.colour, 16);
    }
  }
}
