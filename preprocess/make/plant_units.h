// The buildings and machines (units) of the test plant. Each unit is on a lot of 40 m. The lot includes half the width
// of the road around it.
#pragma once

#include "preprocess/make/plant_kit.h"

namespace gnomon::make {

inline constexpr double kLotPitch = 40;

/// Each of these functions adds one unit of the plant at the origin of `site`.
void addTankFarm(Site& site);
void addPipeRack(Site& site); // covers the whole lot in z, so that neighbouring racks join
void addPipeSleepers(Site& site);
void addExchangers(Site& site);
void addTransformers(Site& site);
void addTurbineHall(Site& site);
void addChimney(Site& site);
void addCoolingTower(Site& site);
void addStore(Site& site);
void addGasTurbine(Site& site);

/// The number of storeys of the boiler house. Each storey is a separate unit. Storey 0 is on the ground.
inline constexpr std::uint64_t kBoilerStoreys = 8;
void addBoilerStorey(Site& site, std::uint64_t storey);

} // namespace gnomon::make
