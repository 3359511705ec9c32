#pragma once
// What --help says beyond what was given to the parser.

namespace CLI {
class App;
}

namespace ringcraft {

// Puts the default of every option of the command and of those below it behind what it does, as
// "Muscle tone [1]". Required options have none.
void say_defaults(CLI::App& command);

}  // namespace ringcraft
