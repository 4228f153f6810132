"""Draws a report: index.html, and figures/*.png and *.pdf, from the numbers in report.json; computes none itself.

Usage: python3 draw_report.py FOLDER [--no-figures]
"""
import json
import os
import pathlib
import sys

import charts
import jinja2
import page
import tracking

HERE = pathlib.Path(__file__).resolve().parent


def write(path, text):
    """The file appears complete or not at all."""
    temporary = path.with_name(f'.{path.name}.tmp')
    temporary.write_text(text, encoding='utf-8')
    os.replace(temporary, path)


def draw_page(report, figures):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(str(HERE)), autoescape=True, trim_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    environment.filters.update(page.FILTERS)
    static = {name: page.trusted((HERE / f'page.{name}').read_text(encoding='utf-8')) for name in ('css', 'js')}
    sections = [page.view(section, figures.get(section['kind'], [])) for section in report['sections']]
    return environment.get_template('page.html.j2').render(
        title=report['title'], version=report['version'], sections=sections, fewest_of_a_line=charts.FEWEST_OF_A_LINE,
        trackers=tracking.view(report['trackers'], figures.get('tracking', [])), **static)


def main():
    folder = pathlib.Path(sys.argv[1])
    report = json.loads((folder / 'report.json').read_text(encoding='utf-8'))
    listed = {}
    if '--no-figures' not in sys.argv[2:]:
        import figures  # matplotlib takes its time
        text, listed = figures.draw(report, folder)
        write(folder / 'figures.tex', text)
    write(folder / 'index.html', draw_page(report, listed))


if __name__ == '__main__':
    main()
