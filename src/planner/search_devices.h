#pragma once
// What a search does beyond alpha-beta, each with its switch. None changes a value: they change how
// many nodes are looked at.

namespace ringcraft {

struct SearchDevices {
  bool own_order = true;  // the game's order of its moves; else by their keys
  bool table = true;      // transposition table
  bool killers = true;    // moves that cut off at the same depth are tried early
  bool history = true;    // so are moves that cut off anywhere
};

}  // namespace ringcraft
