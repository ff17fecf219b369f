"""Steps a packaged encounter in libcosim and reads a value.

shipcollision package guan2014 --osp
python examples/osp_folder.py guan2014-osp
"""

import sys

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver

log_output_level(CosimLogLevel.WARNING)
execution = CosimExecution.from_osp_config_file(sys.argv[1])
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
collision = execution.slave_index_from_instance_name("collision")
references = {variable.name.decode(): variable.reference for variable in execution.slave_variables(collision)}
execution.step(120)  # of 0.05 s each
(energy,) = observer.last_real_values(collision, [references["energy.dissipated"]])
print(f"energy lost to contact: {energy / 1e6:.3f} MJ")
