# SPDX-License-Identifier: GPL-2.0-only
"""Several instances of LAMMPS in one process, through its C library interface: each has the styles of the plugin,
in whatever order instances are opened and closed. Each test is a process of its own, which a crash ends."""
import os
import subprocess
import sys
import textwrap
import unittest
from pathlib import Path

from two_particles import SETUP

LMP = Path(os.environ.get("EEPA_STOCK_LMP") or "lmp")
PLUGIN = os.environ.get("EEPA_PLUGIN") or ""
LIBRARY = next((path for path in (LMP.parent / "liblammps.so", LMP.parent / "liblammps.dylib")
                if path.is_file()), None)

#: What each process begins with: an instance, in which two particles bounce at each other.
BEGIN = '''
import ctypes
library = ctypes.CDLL({library!r}, ctypes.RTLD_GLOBAL)
library.lammps_open_no_mpi.restype = ctypes.c_void_p
library.lammps_extract_variable.restype = ctypes.POINTER(ctypes.c_double)
plugin = {plugin!r}

class Lammps:
    def __init__(self):
        words = [b"lmp", b"-log", b"none", b"-screen", b"none", b"-nocite"]
        self.me = ctypes.c_void_p(library.lammps_open_no_mpi(len(words), (ctypes.c_char_p * len(words))(*words), None))

    def __call__(self, lines):
        library.lammps_commands_string(self.me, lines.encode())
        if library.lammps_has_error(self.me):
            words = ctypes.create_string_buffer(1000)
            library.lammps_get_last_error_message(self.me, words, 1000)
            raise RuntimeError(words.value.decode())

    def setup(self):
        self({two_particles!r})
        self("""fix wall all wall/gran/eepa linear coeff 1e4 4e4 0 0 0 wall zplane -1 NULL
compute n all gran/eepa/contacts
compute e all gran/eepa/energy
compute each all gran/eepa/energy/atom
compute dt all gran/eepa/dt
thermo_style custom step c_n[1] c_dt f_wall[6]
""")

    def bounces(self):
        """The particles meet, and part with sqrt(k1/k2) of their speed."""
        self("run 8000")
        self.bounced()

    def bounced(self):
        value = library.lammps_extract_variable(self.me, b"e", None)[0]
        assert abs(value - 0.5) < 1e-3, value

    def close(self):
        library.lammps_close(self.me)
'''


@unittest.skipIf(os.environ.get("EEPA_SANITIZE"), "a stock LAMMPS can not load an instrumented plugin")
@unittest.skipUnless(LIBRARY and PLUGIN, "started by hand: ctest says where LAMMPS's library and the plugin are")
class Instances(unittest.TestCase):
    def process(self, text, on_path=True):
        environment = {name: value for name, value in os.environ.items() if name != "LAMMPS_PLUGIN_PATH"}
        if on_path:
            environment["LAMMPS_PLUGIN_PATH"] = str(Path(PLUGIN).parent)
        program = BEGIN.format(library=str(LIBRARY), plugin=PLUGIN, two_particles=SETUP) + textwrap.dedent(text) + '\nprint("to the end")\n'
        done = subprocess.run([sys.executable, "-c", program], env=environment, text=True, timeout=120,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("to the end", done.stdout)
        return done.stdout

    def test_in_turn(self):
        self.process('''
            for _ in range(3):
                a = Lammps(); a.setup(); a.bounces(); a.close()''')

    def test_at_the_same_time_and_the_first_ends_first(self):
        self.process('''
            a, b = Lammps(), Lammps()
            a.setup(); b.setup()
            a("run 4000"); b.bounces(); a("run 4000"); a.bounced()
            a.close()
            b("run 10"); b.bounced(); b.close()''')

    def test_at_the_same_time_and_the_second_ends_first(self):
        self.process('''
            a, b = Lammps(), Lammps()
            a.setup(); b.setup()
            b.bounces(); b.close()
            a.bounces(); a.close()''')

    def test_a_third_after_the_first(self):
        self.process('''
            a, b = Lammps(), Lammps()
            a.setup(); a.close()
            c = Lammps()
            c.setup(); b.setup(); b.bounces(); b.close(); c.bounces(); c.close()''')

    def test_clear_in_one_leaves_the_other(self):
        self.process('''
            a, b = Lammps(), Lammps()
            a.setup(); b.setup()
            a("clear"); b.bounces(); a.setup(); a.bounces()
            b("clear"); b.setup(); b.bounces(); a("run 10")
            b.close(); a.close()''')

    def test_loaded_by_command_in_each(self):
        self.process('''
            a, b = Lammps(), Lammps()
            for one in (a, b):
                one(f"plugin load {plugin}"); one.setup()
            b.close(); a.bounces(); a.close()''', on_path=False)

    def test_an_instance_without_the_plugin_ends_first(self):
        # LAMMPS then closes the library, of which the other instance has the code.
        self.process('''
            a = Lammps(); a(f"plugin load {plugin}"); a.setup()
            b = Lammps(); b("units si"); b.close()
            a.bounces(); a.close()''', on_path=False)

    def test_unloaded_in_one_leaves_the_other(self):
        self.process('''
            a, b = Lammps(), Lammps()
            a.setup(); b.setup()
            a("plugin clear"); b.bounces(); b.close()
            try:
                a("pair_style gran/eepa linear")
            except RuntimeError as error:
                assert "gran/eepa" in str(error), error
            else:
                raise AssertionError("a has it still")
            a(f"plugin load {plugin}"); a("pair_style gran/eepa linear"); a.close()''')

    def test_from_a_copy_of_the_plugin(self):
        self.process('''
            import shutil, tempfile
            with tempfile.TemporaryDirectory() as folder:
                copy = shutil.copy(plugin, folder)
                a, b = Lammps(), Lammps()
                a(f"plugin load {plugin}"); a.setup()
                b(f"plugin load {copy}"); b.setup()
                a.bounces(); a.close(); b.bounces(); b.close()''', on_path=False)

    def test_an_error_of_the_plugin_is_an_error_of_its_instance_only(self):
        # It is thrown in the plugin and caught in liblammps.
        self.process('''
            a, b = Lammps(), Lammps()
            a.setup(); b.setup()
            try:
                b("pair_coeff 1 1 -1 4e4 0 0 0")
            except RuntimeError as error:
                assert "k1" in str(error), error
            else:
                raise AssertionError("no error")
            a.bounces(); a.close(); b.close()''')


if __name__ == "__main__":
    unittest.main()
