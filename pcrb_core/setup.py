"""Builds the Python package pcrb and the library under it by CMake, without ROS: pip install ./pcrb_core.

Needs what pcrb_core needs (docs/building.md) and pybind11-dev; JOBS=N sets the number of parallel compilers.
"""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        output = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        build = pathlib.Path(self.build_temp).resolve()
        jobs = os.environ.get('JOBS', str(len(os.sched_getaffinity(0))))
        subprocess.run(['cmake', '-S', SOURCE, '-B', build, '-Wno-dev', '-DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON',
                        '-DBUILD_TESTING=OFF', '-DCMAKE_REQUIRE_FIND_PACKAGE_pybind11=ON',
                        f'-DPYTHON_EXECUTABLE={sys.executable}', f'-DPCRB_PYTHON_OUTPUT={output}'], check=True)
        subprocess.run(['cmake', '--build', build, '--target', 'pcrb_python', '--parallel', jobs], check=True)


version = re.search(r'<version>(.*)</version>', (SOURCE / 'package.xml').read_text()).group(1)
# Here and not in pyproject.toml, which setuptools reads since 61 only: Ubuntu 20.04 has 45.
setup(name='pcrb', version=version, description='Metric and files of the point cloud registration benchmark',
      license='BSD-3-Clause', python_requires='>=3.8', install_requires=['numpy'], packages=['pcrb'],
      package_dir={'': 'python'}, ext_modules=[Extension('pcrb._pcrb', [])], cmdclass={'build_ext': CMakeBuild},
      zip_safe=False)
