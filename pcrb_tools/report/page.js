// What a page can do beyond its text: titles of marks under the pointer and where it is tapped, tables that sort and filter, methods
// that are switched off in all charts of their section, commands that are copied. Without it everything is there to read.
(function () {
  'use strict';
  function make(name, properties) { return Object.assign(document.createElement(name), properties); }
  function each(selector, take, root) { (root || document).querySelectorAll(selector).forEach(take); }

  function tips() {
    var tip = document.body.appendChild(make('div', { id: 'tip' })), shown = null, title = null;
    tip.setAttribute('role', 'status');
    each('svg title', function (found) { found.parentNode.setAttribute('data-tip', found.textContent); });
    function hide() {  // the title, which the browser would show as well, comes back
      if (title) { shown.appendChild(title); }
      shown = title = null;
      tip.style.display = 'none';
    }
    function show(event) {
      var mark = event.target.closest && event.target.closest('[data-tip]');
      if (mark !== shown) {
        hide();
        if (!mark) { return; }
        shown = mark;
        title = mark.querySelector('title');
        if (title) { mark.removeChild(title); }
        tip.textContent = mark.getAttribute('data-tip');
        tip.style.display = 'block';
      }
      if (!mark) { return; }
      var x = Math.min(event.clientX + 14, window.innerWidth - tip.offsetWidth - 8), y = event.clientY - tip.offsetHeight - 12;
      tip.style.left = Math.max(8, x) + 'px';
      tip.style.top = (y < 8 ? event.clientY + 18 : y) + 'px';
    }
    document.addEventListener('pointermove', show);
    document.addEventListener('pointerdown', show);
    document.addEventListener('scroll', hide, true);
  }

  // A cell's number, without its interval; nothing for a text.
  function valueOf(cell) {
    var text = cell.firstChild ? cell.firstChild.textContent.trim() : '';
    var number = parseFloat(text.replace(/^[<≤] ?/, ''));
    return { text: text, number: isNaN(number) ? (text === '–' ? Infinity : null) : number };
  }

  function sortBy(table, column, is_descending) {
    each('tbody', function (body) {
      var rows = Array.prototype.filter.call(body.rows, function (row) { return !row.classList.contains('level'); });
      var is_number = rows.every(function (row) { return valueOf(row.cells[column]).number !== null; });
      rows.map(function (row, place) { return { row: row, place: place, value: valueOf(row.cells[column]) }; })
        .sort(function (a, b) {
          var order = is_number ? (a.value.number === b.value.number ? 0 : a.value.number < b.value.number ? -1 : 1)
            : a.value.text.localeCompare(b.value.text, undefined, { numeric: true });
          return (is_descending ? -order : order) || a.place - b.place;
        })
        .forEach(function (entry) { body.appendChild(entry.row); });
    }, table);
  }

  function sortable(table) {
    each('thead th', function (header) {
      var button = make('button', { type: 'button' });
      while (header.firstChild) { button.appendChild(header.firstChild); }
      header.appendChild(button);
      button.addEventListener('click', function () {
        var is_descending = header.getAttribute('aria-sort') === 'ascending';
        each('thead th', function (other) { other.removeAttribute('aria-sort'); }, table);
        header.setAttribute('aria-sort', is_descending ? 'descending' : 'ascending');
        sortBy(table, header.cellIndex, is_descending);
      });
    }, table);
  }

  function filterable(table) {
    if (table.querySelectorAll('tbody tr').length < 9) { return; }
    var field = make('input', { type: 'search', placeholder: 'filter rows', className: 'filter' });
    field.setAttribute('aria-label', 'filter rows');
    table.parentNode.parentNode.insertBefore(field, table.parentNode);
    field.addEventListener('input', function () {
      var words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
      each('tbody tr:not(.level)', function (row) {
        var text = row.textContent.toLowerCase();
        row.hidden = !words.every(function (word) { return text.indexOf(word) >= 0; });
      }, table);
    });
  }

  function switches(section) {
    var off = {};
    function update() {
      each('[data-method]', function (mark) { mark.style.display = off[mark.getAttribute('data-method')] ? 'none' : ''; }, section);
      each('button[data-key]', function (key) { key.setAttribute('aria-pressed', String(!off[key.getAttribute('data-key')])); }, section);
    }
    each('.key span[data-key]', function (entry) {
      var button = make('button', { type: 'button', title: 'show or hide in all charts' });
      button.setAttribute('data-key', entry.getAttribute('data-key'));
      button.setAttribute('style', entry.getAttribute('style'));
      while (entry.firstChild) { button.appendChild(entry.firstChild); }
      entry.parentNode.replaceChild(button, entry);
      button.addEventListener('click', function () {
        var name = button.getAttribute('data-key');
        off[name] = !off[name];
        update();
      });
    }, section);
    update();
  }

  function copies(code) {
    var button = make('button', { type: 'button', textContent: 'copy', className: 'copy' });
    code.parentNode.insertBefore(button, code);
    button.addEventListener('click', function () {
      var range = document.createRange();
      range.selectNodeContents(code);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      button.textContent = document.execCommand('copy') ? 'copied' : 'press Ctrl+C';
    });
  }

  // The second column of names stays beside the first.
  function stick(table) {
    var first = table.querySelector('tbody th');
    if (first) { table.style.setProperty('--first', first.offsetWidth + 'px'); }
  }

  tips();
  each('table.sortable', function (table) { sortable(table); filterable(table); });
  each('main section', switches);
  each('td code', copies);
  each('table.keys2', stick);
  window.addEventListener('resize', function () { each('table.keys2', stick); });
  document.addEventListener('toggle', function (event) { each('table.keys2', stick, event.target); }, true);
}());
