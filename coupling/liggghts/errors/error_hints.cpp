// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/liggghts/errors/error_hints.h"

#include <algorithm>
#include <array>

namespace furrow::coupling {

namespace {

struct Hint {
  const char* start;  // of the message
  const char* text;
};

constexpr std::array hints = {
    Hint{"Could not find fix group ID",
         "the argument after the id of a fix is a group of grains: write 'all', or define the "
         "group before"},
    Hint{"Replacing a fix, but new style != old style",
         "another fix has this id already: choose another id, or write 'unfix <id>' before"},
    Hint{"Could not find thermo custom fix ID",
         "an f_ID of thermo_style names a fix that is not there: correct the id, or write that fix "
         "before"},
    Hint{"Could not find thermo fix ID",
         "an f_ID of thermo_style names a fix that an unfix has removed: write a thermo_style "
         "without it before the run"},
    Hint{"Could not find thermo custom variable name",
         "a v_name of thermo_style names a variable that is not there"},
    Hint{"Could not find thermo variable name",
         "a v_name of thermo_style names a variable that has been deleted"},
    Hint{
        "Fix ID for fix ave/time does not exist",
        "an f_ID of that fix ave/time names a fix that is not there, or that an unfix has removed: "
        "remove the fix ave/time too"},
    Hint{"Atom sorting has bin size = 0.0",
         "without grains there is nothing to sort by: write 'atom_modify sort 0 0' before the box"},
    Hint{"fix property/atom (id",
         "if a checkpoint was read, it is that of another scene: continue with the lines of the "
         "first run"},
    Hint{"Could not find fix ID to delete", "no fix has the id that unfix names"},
    Hint{"Run command before simulation box is defined",
         "a scene begins with its box: write 'region' and 'create_box', 'read_restart' or 'bed' "
         "before; 'clear' removes all of it"},
    Hint{"Fix command before simulation box is defined",
         "a scene begins with its box: write 'region' and 'create_box', 'read_restart' or 'bed' "
         "before"},
    Hint{"Invalid run command N value",
         "run takes a number of steps from 0 to 2147483647; write several runs for more"},
    Hint{
        "Invalid run command upto value",
        "'run N upto' ends at step N, which must not be past, nor more than 2147483647 steps away"},
    Hint{"Minimization could not find thermo_pe compute",
         "bodies and grains move in time: write 'run' in the place of 'minimize'"},
    Hint{
        "Specified processors != physical processors",
        "the numbers behind 'processors' must multiply to the number of ranks: write '*' for those "
        "that may be chosen, or start as many ranks"},
    Hint{"Processors command after simulation box is defined",
         "write this line before the box is made"},
    Hint{"Box bounds are invalid",
         "each upper bound of the region must be larger than the lower one: check the variables "
         "that it is made of"},
    Hint{"Unable to calculate region volume",
         "nothing fits into the region: it is empty, or outside of the box"},
    Hint{"Expected floating point parameter",
         "an argument of this line must be a number, without a unit"},
    Hint{"Expected integer parameter", "an argument of this line must be a whole number"},
    Hint{"Substitution for illegal variable",
         "a ${name} of this line has no value: write 'variable <name> index <value>' before, or "
         "give it with -var"},
    Hint{"Illegal run command",
         "write 'run <steps>', with the keywords upto, start, stop, pre, post or every; '&' at the "
         "end of a line takes the next one as a part of it"},
    Hint{"Invalid value in set command",
         "a type is a number from 1 to that of create_box; diameters, densities and masses are "
         "above 0"},
    Hint{"All masses are not set",
         "write 'atom_style granular' before the box is made: Furrow's grains are spheres, and a "
         "scene without any needs no masses then"},
    Hint{"Extruded triangle count is zero",
         "the body that mesh/body names has no surface: for a terrain write 'surface_mesh yes' in "
         "its "
         "line"},
    Hint{"Too many atom sorting bins",
         "the box of region and create_box is very large for its grains: look for a length in "
         "mm, or write 'atom_modify sort 0 0'"},
    Hint{"Gravity direction vector = 0",
         "the vector of fix gravity points nowhere: write 'vector 0 0 -1'"},
    Hint{"Atom types must start from 1",
         "there are no grains: create some before the run, or remove the lines that need them"},
    Hint{"Random number generation",
         "the number behind 'seed' in the line below is a prime above 10000: write one of those"},
    Hint{"Illegal restart command",
         "write 'restart <steps> <file>' with steps above 0, or 'restart 0' alone for none"},
    Hint{"Cannot open input script",
         "no file of that name can be read: paths of include and jump count from the folder in "
         "which furrow is started"},
    Hint{"Unknown command",
         "LIGGGHTS has no command of that name: check its spelling, and that this file is an input "
         "script"},
    Hint{"Unknown normal model",
         "snow/bond takes no further models: write 'model snow/bond' without tangential, cohesion, "
         "rolling_friction and surface"},
    Hint{"Invalid fix style", "check its spelling; coupling/README.md lists Furrow's"},
};

}  // namespace

std::string hint_for(const std::string& message) {
  const auto found = std::find_if(hints.begin(), hints.end(), [&](const Hint& hint) {
    return message.rfind(hint.start, 0) == 0;
  });
  return found == hints.end() ? "" : found->text;
}

}  // namespace furrow::coupling
