#pragma once
// What a search does beyond alpha-beta, each with its switch. None changes a value: they change how
// many nodes are looked at.

namespace ringcraft {

struct SearchDevices {
  bool own_order = true;     // the game's order of its moves; else by their keys
  bool table = true;         // transposition table
  bool killers = true;       // moves that cut off at the same depth are tried early
  bool history = true;       // so are moves that cut off anywhere
  bool answers = false;      // so are moves that cut off in answer to the same thing
  bool null_window = false;  // all but the first move of a node: first only whether they are better
};

}  // namespace ringcraft
