"""A screen without a monitor, for programs with windows, and what is to be seen on it."""
import os
import shutil
import struct
import unittest

import numpy as np
from pcrb_testing import Child
from pcrb_testing_wait import LIMIT, wait_until


def require_screen():
    """Skips the test where windows cannot be shown."""
    for program in 'Xvfb', 'rviz':
        if not shutil.which(program):
            raise unittest.SkipTest(f'{program} is not installed: nothing can be looked at')


class Screen(Child):
    """Xvfb, which keeps the picture in a file; drawn in software, without a mouse pointer."""

    def __init__(self, folder):
        self._file = os.path.join(folder, 'Xvfb_screen0')
        super().__init__(['Xvfb', '-displayfd', '1', '-nocursor', '-screen', '0', '1280x800x24', '-fbdir', folder])
        self.display = ':' + self.wait_for_output(r'\d+\n').group().strip()

    def environment(self):
        """For programs that are to show themselves here."""
        return {'DISPLAY': self.display, 'LIBGL_ALWAYS_SOFTWARE': '1', 'QT_X11_NO_MITSHM': '1'}

    def picture(self):
        """Height x width x 3, red green blue, of what an XWD file holds."""
        with open(self._file, 'rb') as file:
            data = file.read()
        header = struct.unpack('>25I', data[:100])
        size, width, height, row_bytes, colors = header[0], header[4], header[5], header[12], header[19]
        rows = np.frombuffer(data, np.uint8, row_bytes * height, size + 12 * colors)
        return rows.reshape(height, -1, 4)[:, :width, 2::-1]

    def save(self, path):
        """As PPM, which every viewer of pictures knows."""
        picture = self.picture()
        with open(path, 'wb') as file:
            file.write(b'P6 %d %d 255\n' % (picture.shape[1], picture.shape[0]) + picture.tobytes())


def inside(picture, background):
    """The part of a picture that has a background colour up to its corners."""
    y, x = np.nonzero((picture == background).all(axis=2))
    return picture[y.min():y.max() + 1, x.min():x.max() + 1] if len(y) else picture[:0, :0]


def count(picture, color):
    """Pixels of exactly a colour."""
    return int((picture == color).all(axis=2).sum())


def started_and_seen(start, end, screen, background, colors):
    """A program that start() starts, and the part of the screen with that background, once it shows all the colours.

    end(program) ends it, and it is started once more, if it shows nothing: that rviz misses latched messages was seen once in CI,
    and not in 750 starts of one configuration here.
    """
    program = start()
    try:
        return program, wait_for_colors(screen, program, background, colors, LIMIT / 2)
    except AssertionError as error:
        print(error, flush=True)
    end(program)
    program = start()
    return program, wait_for_colors(screen, program, background, colors)


def wait_for_colors(screen, program, background, colors, limit=LIMIT):
    """The part of the screen with that background, once the program shows all the colours; it must not end before."""
    at_least = 10

    def shown():
        has_ended = program.ended()
        picture = inside(screen.picture(), background)
        if all(count(picture, color) >= at_least for color in colors):
            return [picture]
        if has_ended:
            raise AssertionError('it ended')
        return []
    try:
        return wait_until(shown, f'the colours {colors} are seen', limit)[0]
    except AssertionError as error:
        found = {color: count(inside(screen.picture(), background), color) for color in colors}
        raise AssertionError(f'{program.command[0]}: {error}; found pixels {found}, expected at least {at_least} of each:\n'
                             f'{program.output()}') from None
