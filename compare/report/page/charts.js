// Charts of a study: two logarithmic axes, a curve for each contender, drawn by Chart.js.

// Distinct without colour, too: each curve has a mark of its own.
const MARKS = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot', 'cross', 'rectRounded'];
const SHAPES = ['\u25cf', '\u25a0', '\u25b2', '\u25c6', '\u2731', '\u2715', '\u271a', '\u25a2'];

/// Whole powers of ten carry a label; the rest only a line.
function powers(value) {
  const power = Math.round(Math.log10(value) * 1e9) / 1e9;
  if (!Number.isInteger(power)) return '';
  return Math.abs(power) > 4 ? `1e${power}` : value.toLocaleString('en', {maximumSignificantDigits: 1});
}

function logAxis(title, {text, grid}) {
  return {
    type: 'logarithmic',
    title: {display: true, text: title, color: text},
    ticks: {color: text, callback: powers, maxRotation: 0, autoSkip: false},
    grid: {color: grid},
  };
}

function datasetOf(series, i) {
  const list = INKS[darkPreferred() ? 'dark' : 'light'], colour = list[i % list.length];
  return {
    label: series.name,
    data: series.points,
    hidden: !series.shown,
    borderColor: colour,
    backgroundColor: colour,
    borderWidth: 1.5,
    pointStyle: MARKS[i % MARKS.length],
    pointRadius: series.points.map((point) => (point.front ? 7 : 4)),
    pointHoverRadius: 8,
    borderDash: DASHES[Math.floor(i / MARKS.length) % DASHES.length],
  };
}

function chartSettings(chart, series, colours) {
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
      scales: {x: logAxis(chart.x, colours), y: logAxis(chart.y, colours)},
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
    this.charts = charts.map((chart) => ({...chart, name: chart.title.split(':')[0]}));
    this.shown = this.charts.find((chart) => chart.name === first) || this.charts[0];
    this.select = el(
        'select', {}, this.charts.map((chart) => el('option', {selected: chart === this.shown}, chart.name)));
    this.select.addEventListener('change', () => {
      this.shown = this.charts[this.select.selectedIndex];
      this.draw();
    });
    this.caption = el('p', {class: 'chart-title'});
    this.frame = el('div', {class: 'chart'});
    this.legend = el('div', {class: 'legend curves', role: 'group', 'aria-label': 'Curves shown'});
    this.numbers = el('div', {});
    this.root = el(
        'div', {class: 'picture'},
        this.charts.length > 1 ? el('label', {class: 'quiet'}, 'Motion ', this.select) : null, this.caption,
        el('div', {class: 'chart-and-legend'}, this.frame, this.legend), this.numbers);
  }

  draw() {
    if (this.chart) this.chart.destroy();
    const {shown} = this, canvas = el('canvas', {role: 'img', 'aria-label': shown.title});
    this.caption.textContent = shown.title;
    this.frame.replaceChildren(canvas);
    this.chart = new Chart(canvas, chartSettings(shown, shown.series, theme()));
    // For whoever looks from outside: how many points each curve has that is drawn.
    canvas.dataset.points = this.chart.data.datasets.map((dataset) => dataset.data.length).join(' ');
    this.legend.replaceChildren(...shown.series.map((series, i) => this.legendButton(series, i)));
    this.numbers.replaceChildren(chartNumbers(shown));
  }

  legendButton(series, i) {
    const {borderColor} = this.chart.data.datasets[i];
    const button =
        el('button', {type: 'button', 'aria-pressed': String(series.shown)},
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
