#pragma once
// Which joints move a point of the skin, and by how much.

#include "io/anatomy.h"

namespace ringcraft {

// Weights of a point of the T-pose. Smooth over the whole body; a point follows only the bones of
// its own neighbourhood, so that arms do not drag the ribs and thighs do not drag each other.
SkinWeights skin_weights(const Build& build, Vec3 point);

// Everything follows one joint.
SkinWeights rigid_weights(Joint joint);

}  // namespace ringcraft
