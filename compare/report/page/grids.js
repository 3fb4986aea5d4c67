// Heat maps: how many of the cases at a place on two axes are bad. Blue: none; orange with a dot: some; dark with a
// cross: all; so that nobody has to tell them apart by colour alone.

const MAP = {
  left: 54,
  bottom: 34,
  top: 4,
  right: 4,
  row: 24
};

/// How a cell is filled and marked, by the share of its cases that are bad.
function cellLook([bad, all], dark) {
  if (all === 0) return {fill: 'transparent', mark: '\u2013'};
  if (bad === 0) return {fill: dark ? '#24506f' : '#a9d2ec', mark: ''};
  if (bad === all) return {fill: dark ? '#d9603b' : '#c2410c', mark: '\u2715'};
  const share = bad / all;
  return {fill: `hsl(35 ${dark ? 60 : 90}% ${dark ? 34 + 14 * share : 82 - 20 * share}%)`, mark: '\u2022'};
}

/// Of a cell of a heat map: the address of its replay, or, as 'at', of the map with this cell marked.
function addressOfCell(study, grid, {column, row}, as = 'cell') {
  return `#${new URLSearchParams({study: study.key, map: grid.key, [as]: `${column},${row}`})}`;
}

/// A cell that an address asks for as 'cell' or 'at': null where it is none of the map.
function cellIn(grid, wanted, as) {
  const [column, row] = (wanted.get(as) || '').split(',').map(Number);
  return (grid.cells[row] || [])[column] ? {column, row} : null;
}

function placeInWords(grid, {column, row}) {
  if (grid.labels) return `${grid.ys[row]}, ${grid.xs[column]}`;
  return `${grid.x} = ${grid.xs[column]}${grid.y ? `, ${grid.y} = ${grid.ys[row]}` : ''}`;
}

class HeatMap {
  constructor(study, grid, tell) {
    Object.assign(this, {study, grid, tell, at: null});
    const cells = grid.cells.flat(), bad = cells.reduce((sum, cell) => sum + cell[0], 0),
          all = cells.reduce((sum, cell) => sum + cell[1], 0);
    this.title = `${grid.title}: ${grouped(bad)} of ${grouped(all)} cases ${grid.bad_words}`;
    this.canvas = el('canvas', {
      tabindex: '0',
      role: 'img',
      'aria-label': `${this.title}. Arrow keys go from cell to cell, Enter replays one.`,
      style: `height:${MAP.top + MAP.bottom + MAP.row * grid.ys.length}px`
    });
    this.root = el('figure', {class: 'map'}, el('figcaption', {}, this.title), this.canvas);
    this.canvas.addEventListener('pointermove', (event) => this.point(event));
    this.canvas.addEventListener('pointerleave', () => this.go(null));
    this.canvas.addEventListener('click', (event) => {
      this.point(event);
      this.open();
    });
    this.canvas.addEventListener('keydown', (event) => this.key(event));
  }

  get columns() {
    return this.grid.xs.length;
  }
  get rows() {
    return this.grid.ys.length;
  }
  get cellWidth() {
    return (this.canvas.clientWidth - MAP.left - MAP.right) / this.columns;
  }
  /// Larger values stand higher.
  cornerOf(column, row) {
    return [MAP.left + column * this.cellWidth, MAP.top + (this.rows - 1 - row) * MAP.row];
  }

  point(event) {
    const box = this.canvas.getBoundingClientRect();
    const column = Math.floor((event.clientX - box.left - MAP.left) / this.cellWidth),
          row = this.rows - 1 - Math.floor((event.clientY - box.top - MAP.top) / MAP.row);
    this.go(column >= 0 && column < this.columns && row >= 0 && row < this.rows ? {column, row} : null);
  }

  key(event) {
    const ways = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const way = ways[event.key];
    if (!way && event.key !== 'Enter') return;
    event.preventDefault();
    if (!way) return this.open();
    const {column, row} = this.at || {column: -way[0], row: -way[1]};
    this.go({
      column: Math.max(0, Math.min(this.columns - 1, column + way[0])),
      row: Math.max(0, Math.min(this.rows - 1, row + way[1]))
    });
  }

  go(at) {
    this.at = at;
    this.canvas.style.cursor = at && this.replay !== undefined ? 'pointer' : '';
    this.draw();
    if (!at) return;
    const {grid} = this, [bad, all, words, command] = grid.cells[at.row][at.column];
    const counted = all === 0 ? 'nothing ran' : `${grouped(bad)} of ${grouped(all)} ${grid.bad_words}`;
    const sentence = el('strong', {}, `${grid.title} at ${placeInWords(grid, at)}: ${counted}.`);
    if (all === 0) return this.tell([sentence]);
    const how = this.replay === undefined ?
        ['No replay of it is in this page; in a terminal: ', el('code', {}, command)] :
        ['Click or Enter: its replay.'];
    this.tell([sentence, ` ${bad > 0 ? 'The first of them' : 'The first case'}: ${words}. `, ...how]);
  }

  /// Which of the study's replays the cell has that is pointed at.
  get replay() {
    return this.grid.cells[this.at.row][this.at.column][4];
  }

  /// Whoever comes back by the browser finds the cell marked.
  open() {
    if (!this.at || this.replay === undefined) return;
    history.replaceState(null, '', addressOfCell(this.study, this.grid, this.at, 'at'));
    location.hash = addressOfCell(this.study, this.grid, this.at);
  }

  draw() {
    const {canvas, grid} = this, ratio = window.devicePixelRatio || 1, dark = darkPreferred(), colours = theme();
    const width = canvas.clientWidth, height = canvas.clientHeight, c = canvas.getContext('2d');
    [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.font = '11px system-ui, sans-serif';
    c.textBaseline = 'middle';
    c.textAlign = 'center';
    grid.cells.forEach(
        (line, row) => line.forEach((cell, column) => this.drawCell(c, cell, column, row, dark, colours)));
    this.drawBorder(c, colours);
    this.drawAxes(c, colours, width, height);
    if (!this.at) return;
    const [x, y] = this.cornerOf(this.at.column, this.at.row);
    c.strokeStyle = colours.accent;
    c.lineWidth = 2.5;
    c.strokeRect(x, y, this.cellWidth, MAP.row);
  }

  drawCell(c, cell, column, row, dark, colours) {
    const [x, y] = this.cornerOf(column, row), {fill, mark} = cellLook(cell, dark);
    c.fillStyle = fill;
    c.fillRect(x, y, Math.max(1, this.cellWidth - 1), MAP.row - 1);
    if (this.cellWidth < 9) return;
    c.fillStyle = mark === '\u2715' ? (dark ? '#16181a' : '#ffffff') : colours.text;
    c.fillText(mark, x + this.cellWidth / 2, y + MAP.row / 2);
  }

  /// Between cells where none is bad and cells where some are.
  drawBorder(c, colours) {
    const sound = (column, row) => {
      const cell = (this.grid.cells[row] || [])[column];
      return cell && cell[1] > 0 ? cell[0] === 0 : null;
    };
    const differ = (a, b) => a !== null && a !== undefined && b !== null && b !== undefined && a !== b;
    c.strokeStyle = colours.text;
    c.lineWidth = 2.5;
    c.beginPath();
    for (let row = 0; row < this.rows; ++row)
      for (let column = 0; column < this.columns; ++column) {
        const [x, y] = this.cornerOf(column, row), here = sound(column, row);
        if (differ(here, sound(column + 1, row))) {
          c.moveTo(x + this.cellWidth - 0.5, y);
          c.lineTo(x + this.cellWidth - 0.5, y + MAP.row);
        }
        if (differ(here, sound(column, row + 1))) {
          c.moveTo(x, y - 0.5);
          c.lineTo(x + this.cellWidth, y - 0.5);
        }
      }
    c.stroke();
  }

  drawAxes(c, colours, width, height) {
    const {grid} = this, every = Math.max(1, Math.ceil(34 / this.cellWidth)), bottom = height - MAP.bottom;
    c.fillStyle = colours.quiet;
    grid.xs.forEach((text, column) => {
      if (column % every === 0) c.fillText(text, MAP.left + (column + 0.5) * this.cellWidth, bottom + 9);
    });
    c.fillText(grid.x, (MAP.left + width) / 2, height - 8);
    c.textAlign = 'right';
    grid.ys.forEach((text, row) => c.fillText(text, MAP.left - 4, this.cornerOf(0, row)[1] + MAP.row / 2));
  }
}

/// A grid whose cells are read: a table, each cell with its words. A cell leads to its replay.
function labelTable(study, grid) {
  const kinds = ['holds', 'flagged', 'tunnels'];
  const cell = ([label, gravity], row, column) => {
    const [bad, all, words, command, replay] = grid.cells[row][column], kind = all === 0 ? 'not-applicable' : kinds[gravity];
    const about = all === 0 ? words : `${grid.ys[row]}, ${grid.xs[column]}: ${bad} of ${all} ${grid.bad_words}. ${words}. ${command}`;
    const link = {href: addressOfCell(study, grid, {column, row}) + '&layout=side', title: about};
    return el('td', {class: `cell ${kind}`}, el(replay === undefined ? 'span' : 'a', replay === undefined ? {title: about} : link, label));
  };
  const head = [grid.y, ...grid.xs].map((words) => el('th', {scope: 'col'}, words));
  const rows = grid.labels.map(
      (cells, row) => el('tr', {}, el('th', {scope: 'row'}, grid.ys[row]), cells.map((one, column) => cell(one, row, column))));
  return tableBox(grid.title, [el('thead', {}, el('tr', {}, head)), el('tbody', {}, rows)], 'matrix labels');
}

/// All heat maps of a study, and one line that tells about the cell that is pointed at.
function heatMaps(study) {
  const grids = study.grids.filter((grid) => !grid.labels), tables = study.grids.filter((grid) => grid.labels);
  if (grids.length === 0) return {nodes: tables.map((grid) => labelTable(study, grid)), draw: () => {}, show: () => {}};
  const told = el('p', {class: 'told', role: 'status'}, 'Point at a cell to read about it.');
  const maps = grids.map((grid) => new HeatMap(study, grid, (words) => told.replaceChildren(...words)));
  const up = grids[0].y ? el('p', {class: 'quiet'}, `Upwards: ${grids[0].y}. Across: ${grids[0].x}.`) : null;
  return {
    nodes: [el('div', {}, up, told, el('div', {class: 'maps'}, maps.map((map) => map.root)))],
    draw: () => maps.forEach((map) => map.draw()),
    show: (wanted) => {
      const map = maps.find(({grid}) => grid.key === wanted.get('map'));
      if (!map) return;
      map.canvas.focus({preventScroll: true});
      map.go(cellIn(map.grid, wanted, 'at'));
      map.root.scrollIntoView({block: 'center'});
    }
  };
}
