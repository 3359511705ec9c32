#pragma once
// What comes out of sparring: the records as CSV, the offense/defense table as JSON and as a page.

#include <string>

#include "motion/library.h"
#include "scene/sparring.h"

namespace ringcraft {

// One line a record: attack, defense, offset_s, distance_m, bearing_deg, facing_deg, end.
std::string records_csv(const MotionLibrary& library, const std::vector<SparringRecord>& records);

// Attack by attack the defenses, best first, with launches, successes, best timing and lift.
std::string table_json(const MotionLibrary& library, const OffenseDefenseTable& table);

// A page: attacks by defenses, each field as green as the defense is sure at its best timing.
std::string table_page(const MotionLibrary& library, const OffenseDefenseTable& table);

// A few lines: how many records, and for each kind of blow the defenses that belong to it most.
std::string table_text(const MotionLibrary& library, const Sparring& sparring,
                       const OffenseDefenseTable& table);

}  // namespace ringcraft
