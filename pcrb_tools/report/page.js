// Shows a mark's title at once under the pointer, and where it is tapped.
(function () {
  var tip = document.createElement('div');
  tip.id = 'tip';
  tip.setAttribute('role', 'status');
  document.body.appendChild(tip);
  document.querySelectorAll('svg title').forEach(function (title) {
    title.parentNode.setAttribute('data-tip', title.textContent);
    title.parentNode.removeChild(title);
  });
  function show(event) {
    var mark = event.target.closest && event.target.closest('[data-tip]');
    if (!mark) { tip.style.display = 'none'; return; }
    tip.textContent = mark.getAttribute('data-tip');
    tip.style.display = 'block';
    var x = Math.min(event.clientX + 14, window.innerWidth - tip.offsetWidth - 8);
    var y = event.clientY - tip.offsetHeight - 12;
    tip.style.left = Math.max(8, x) + 'px';
    tip.style.top = (y < 8 ? event.clientY + 18 : y) + 'px';
  }
  document.addEventListener('pointermove', show);
  document.addEventListener('pointerdown', show);
  document.addEventListener('scroll', function () { tip.style.display = 'none'; }, true);
})();
