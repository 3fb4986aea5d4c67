// Charts of a study: two logarithmic axes, a curve for each contender, drawn by Chart.js.

// Distinct without colour, too: each curve has a mark of its own.
const MARKS = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot', 'cross', 'rectRounded'];
const SHAPES = ['\u25cf', '\u25a0', '\u25b2', '\u25c6', '\u2731', '\u2715', '\u271a', '\u25a2'];

/// Powers of ten alone carry a line and a label: 1e-4, 0.001, 1, 100, 1e5.
function power(value) {
  return Math.abs(Math.log10(value)) > 3.5 ? value.toExponential(0).replace('+', '') : String(value);
}

/// Ticks at whole powers of ten, no more than eight.
function powersBetween(axis) {
  const low = Math.ceil(Math.log10(axis.min) - 1e-9), high = Math.floor(Math.log10(axis.max) + 1e-9);
  const every = Math.max(1, Math.ceil((high - low) / 8));
  axis.ticks = [];
  for (let n = low; n <= high; n += every) axis.ticks.push({value: Number(`1e${n}`)});
}

function logAxis(title, values, {text, grid}) {
  return {
    type: 'logarithmic',
    min: 10 ** Math.floor(Math.log10(Math.min(...values) * 0.9)),
    max: 10 ** Math.ceil(Math.log10(Math.max(...values) * 1.1)),
    title: {display: true, text: title, color: text},
    afterBuildTicks: powersBetween,
    ticks: {color: text, callback: power, maxRotation: 0, autoSkip: false},
    grid: {color: grid},
  };
}

/// A contender has the same colour in charts and replays.
function colourOfSeries(series, all) {
  if (series.name.startsWith('law of steps')) return theme().quiet;
  const list = INKS[darkPreferred() ? 'dark' : 'light'], who = (name) => name.split(/[ ,]/)[0];
  const {contenders} = namesWith(all.map((one) => ({contender: who(one.name), mode: 'free', scalar: 'double'})));
  return list[contenders.indexOf(who(series.name)) % list.length];
}

/// What is struck out or hollow does not count; the curve of our own is the thick one.
function datasetOf(series, i, all) {
  const colour = colourOfSeries(series, all), mark = MARKS[i % MARKS.length], {text} = theme();
  return {
    label: series.name,
    data: series.points,
    hidden: !series.shown,
    borderColor: colour,
    backgroundColor: colour,
    borderWidth: series.name.startsWith('octagon_sweep') ? 3 : 1.5,
    pointBackgroundColor: series.points.map((point) => (point.hollow ? 'transparent' : colour)),
    pointBorderColor: series.points.map((point) => (point.struck ? text : colour)),
    pointStyle: series.points.map((point) => (point.struck ? 'crossRot' : mark)),
    pointRadius: series.points.map((point) => (point.front || point.struck ? 7 : 4)),
    pointHoverRadius: 8,
    borderDash: DASHES[Math.floor(i / MARKS.length) % DASHES.length],
  };
}

function chartSettings(chart, series, colours) {
  const points = series.flatMap((one) => one.points);
  const words = ({dataset, raw}) =>
      [dataset.label, raw.words, `${chart.x}: ${measure(raw.x)}`, `${chart.y}: ${measure(raw.y)}`].filter(Boolean);
  return {
    type: 'line',
    data: {datasets: series.map(datasetOf)},
    options: {
      animation: false,
      maintainAspectRatio: false,
      color: colours.text,
      plugins: {legend: {display: false}, tooltip: {callbacks: {title: () => '', label: words}}},
      scales: {x: logAxis(chart.x, points.map(({x}) => x), colours), y: logAxis(chart.y, points.map(({y}) => y), colours)},
    },
  };
}

/// The numbers of a chart, for those who read rather than look.
function chartNumbers(chart) {
  const rows = chart.series.flatMap(
      (series) => series.points.map(
          (point) => el(
              'tr', {}, el('th', {scope: 'row'}, series.name), el('td', {}, point.words || ''),
              el('td', {class: 'number'}, measure(point.x)), el('td', {class: 'number'}, measure(point.y)))));
  const head = ['Curve', 'Setting', chart.x, chart.y].map((words) => el('th', {scope: 'col'}, words));
  return el(
      'details', {}, el('summary', {}, `Its ${grouped(rows.length)} points in numbers`),
      tableBox(chart.title, [el('thead', {}, el('tr', {}, head)), el('tbody', {}, rows)]));
}

/// One chart at a time, chosen by name; its legend shows and hides the curves.
class ChartPicture {
  /// @param charts of a study; @param first  name of the chart to begin with, if it is there.
  constructor(charts, first) {
    this.charts = charts.map((chart) => ({
      ...chart, name: chart.title.split(':')[0],
      series: chart.series.map((series) => ({...series, own: !series.shown}))
    }));
    this.shown = this.charts.find((chart) => chart.name === first) || this.charts[0];
    const choose = () => {
      this.shown = this.charts[this.select.selectedIndex];
      this.draw();
    };
    this.select = el(
        'select', {onchange: choose},
        this.charts.map((chart) => el('option', {selected: chart === this.shown}, chart.name)));
    this.caption = el('p', {class: 'chart-title'});
    this.frame = el('div', {class: 'chart'});
    const own = el('input', {type: 'checkbox', onchange: () => this.showOwn(own.checked)});
    this.own = el('label', {class: 'quiet small'}, own, ' curves over knobs of their own, too');
    this.legend = el('div', {class: 'legend curves', role: 'group', 'aria-label': 'Curves shown'});
    this.numbers = el('div', {});
    this.root = el(
        'div', {class: 'picture'},
        el('div', {class: 'bar'}, this.charts.length > 1 ? el('label', {}, 'Motion ', this.select) : null,
           charts.some((chart) => chart.series.some((series) => !series.shown)) ? this.own : null),
        this.caption,
        el('div', {class: 'chart-and-legend'}, this.frame, this.legend), this.numbers);
  }

  showOwn(shown) {
    for (const chart of this.charts)
      for (const series of chart.series)
        if (series.own) series.shown = shown;
    this.draw();
  }

  draw() {
    if (this.chart) this.chart.destroy();
    const {shown} = this, canvas = el('canvas', {role: 'img', 'aria-label': shown.title});
    this.caption.textContent = shown.title;
    this.frame.replaceChildren(canvas);
    this.chart = new Chart(canvas, chartSettings(shown, shown.series, theme()));
    // For whoever looks from outside: how many points each curve has that is drawn.
    canvas.dataset.points = this.chart.data.datasets.map((dataset) => dataset.data.length).join(' ');
    this.legend.replaceChildren(
        ...shown.series.map((series, i) => (!series.own || series.shown) ? this.legendButton(series, i) : null)
            .filter(Boolean));
    this.numbers.replaceChildren(chartNumbers(shown));
  }

  legendButton(series, i) {
    const {borderColor} = this.chart.data.datasets[i];
    const button =
        el('button', {type: 'button', title: 'Show or hide', 'aria-pressed': String(series.shown)},
           el('span', {style: `color:${borderColor}`, 'aria-hidden': 'true'}, `${SHAPES[i % SHAPES.length]} `),
           series.name);
    button.addEventListener('click', () => {
      series.shown = !series.shown;
      button.setAttribute('aria-pressed', String(series.shown));
      this.chart.setDatasetVisibility(i, series.shown);
      this.chart.update();
    });
    return button;
  }
}
