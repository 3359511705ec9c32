#pragma once
// What a person writes (scenes, styles, bodies, manifests, technique sheets): TOML, checked against
// a published JSON Schema in assets/schemas. An unknown key is an error that names file, line and
// the nearest known key; after reading, every value has the type its schema says.

#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace ringcraft {

struct Document {
  std::filesystem::path path;
  nlohmann::json value;  // the TOML as JSON (objects, arrays, numbers, strings, booleans)
  std::map<std::string, int> lines;  // JSON pointer ("/fighter/0/style") -> line in the file

  // "line 12"; "--set" for a value that set_value() gave; "" where the pointer is not in the file.
  std::string place(const std::string& pointer) const;
};

// Reads `path` and checks it against assets/schemas/<schema>.schema.json. Schemas use a subset of
// draft 7: type, properties, required, additionalProperties, items, enum, minimum, maximum,
// exclusiveMinimum, exclusiveMaximum, minItems, maxItems, minLength, maxLength, pattern,
// propertyNames, and $ref to "#/definitions/...".
Result<Document> read_document(const std::filesystem::path& path, const std::string& schema);

// The same from text; `path` is only for messages.
Result<Document> parse_document(const std::string& text, const std::filesystem::path& path,
                                const std::string& schema);

// Sets one value, as --set does: "fighter.0.horizon_s=2". The value is read as TOML; a bare word is
// a string. Validation happens again afterwards: call checked().
Result<void> set_value(Document& document, const std::string& assignment);

// Validates `document` against the schema; the first fault is the error.
Result<void> checked(const Document& document, const std::string& schema);

// The published schema as text, for `ringcraft schema NAME`.
Result<std::string> schema_text(const std::string& schema);

}  // namespace ringcraft
