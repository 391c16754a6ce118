"""Small sound files of those kinds that are text: every key and element that a reader knows stands in one of them."""

MODEL = b"""[model]
name = "gearbox 7"
reducer = "RV20E-121"
[settings]
bearing_clearance = "3 um"
[effects.needle_clearance]
needle_clearance_added = { value = 2.1e-6, unit = "m", low = 1.9e-6, high = 2.3e-6 }
[[steps]]
campaign = "c"
effects = ["needle_clearance"]
verdict = "helped"
training_before = 5.0
training_after = 2.0
kept = true
nuisances = { sensor_gain = 1.0 }
signals = [{ signal = "a", held_out = true, unit = "m", before = 2.0, after = 1.0, noise_floor = 0.5 }]
"""
SCENARIO = b"""[scenario]
name = "pair"
step = { value = 1.3, unit = "ms" }
duration = { value = 26, unit = "ms" }
start = { value = 0, unit = "s" }
scheme = "gauss-seidel"
extrapolation = 1
power_threshold = 0.01
call_limit = { step = 30 }
[components.plant]
reducer = "RV20E-121"
unit = "plant"
ratio = 1
parameters = { load_torque = "100 N.m", contact_law = "line" }
record = ["lag", "mesh_force[1,2]"]
[components.wear]
reducer = "RV20E-121"
unit = "wear"
[[connections]]
from = "plant.mesh.force_path"
to = "wear.mesh.force_path"
factor = 1.0
[step_control]
tolerance = 1e-4
[loops]
method = "newton"
[[power_bonds]]
effort = "plant.output.load_torque"
flow = "plant.output.speed"
"""
CAMPAIGN = b"""[campaign]
name = "c"
reducer = "RV20E-121"
rated_torque = "167 N.m"
[conditions.a]
input_speed = { value = 15, unit = "rpm" }
load_torque = "100 N.m"
temperature = "30 degC"
hours = 0
[conditions.b]
output_speed = "1 rpm"
load_torque = "50 N.m"
held_out = true
interventions = []
[layouts.log]
file = "log.csv"
delimiter = ","
columns = { value = { column = "angle", unit = "rad" }, torque = { column = "torque", unit = "N.m" } }
[[runs]]
id = "r1"
layout = "log"
quantity = "hysteresis"
condition = "a"
where = { time = { min = 0.1, max = 0.9 } }
average = { points = 2 }
noise = "1 arcsec"
[[runs]]
id = "r2"
quantity = "lost_motion"
condition = "b"
value = "1 arcmin"
tags = {}
[[runs]]
id = "r3"
quantity = "hysteresis"
condition = "b"
table = { torque = { values = [0, 10, 0, -10, 0], unit = "N.m" }, value = { values = [0, 1, 0, -1, 0], unit = "arcmin" } }
[nuisances.sensor_gain]
unit = "1"
lower = 0.9
start = 1.0
upper = 1.1
per = "campaign"
[rig]
input_speed = ["1 rpm", "100 rpm"]
quantities = ["hysteresis"]
cost_per_run = 1
[quantities.hysteresis]
zero = "free"
[orders]
pins = [40, 80]
"""
NAMES = b'xmlns:ssd="a" xmlns:ssc="b" xmlns:ssv="c" xmlns:ssm="d"'
SSD = b"""<?xml version="1.0"?>
<ssd:SystemStructureDescription %s version="1.0" name="nested">
<ssd:System name="root">
<ssd:ParameterBindings><ssd:ParameterBinding prefix="inner." source="extra.ssv"><ssd:ParameterMapping><ssm:ParameterMapping>
<ssm:MappingEntry source="k" target="k"><ssc:LinearTransformation factor="3" offset="1"/></ssm:MappingEntry></ssm:ParameterMapping></ssd:ParameterMapping>
</ssd:ParameterBinding></ssd:ParameterBindings>
<ssd:Elements>
<ssd:Component name="a" source="resources/a.fmu"><ssd:Connectors><ssd:Connector name="x" kind="output"><ssc:Real unit="mm"/></ssd:Connector>
<ssd:Connector name="u" kind="input"><ssc:Real/></ssd:Connector></ssd:Connectors></ssd:Component>
<ssd:System name="inner"><ssd:Connectors><ssd:Connector name="in" kind="input"><ssc:Real/></ssd:Connector><ssd:Connector name="out" kind="output"/>
<ssd:Connector name="k" kind="parameter"/></ssd:Connectors>
<ssd:Elements><ssd:Component name="b" source="resources/a.fmu"><ssd:Connectors><ssd:Connector name="u" kind="input"><ssc:Real unit="m"/></ssd:Connector>
<ssd:Connector name="x" kind="output"/></ssd:Connectors></ssd:Component></ssd:Elements>
<ssd:Connections><ssd:Connection startConnector="in" endElement="b" endConnector="u"><ssc:LinearTransformation factor="-1"/></ssd:Connection>
<ssd:Connection startElement="b" startConnector="x" endConnector="out"/><ssd:Connection startConnector="k" endElement="b" endConnector="k"/></ssd:Connections>
</ssd:System></ssd:Elements>
<ssd:Connections><ssd:Connection startElement="a" startConnector="x" endElement="inner" endConnector="in"/>
<ssd:Connection startElement="inner" startConnector="out" endElement="a" endConnector="u"/></ssd:Connections>
</ssd:System>
<ssd:Units><ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit><ssc:Unit name="mm"><ssc:BaseUnit m="1" factor="0.001"/></ssc:Unit></ssd:Units>
<ssd:DefaultExperiment startTime="1" stopTime="3"><ssd:Annotations><ssc:Annotation type="t"><M:Master xmlns:M="m" step="0.05"/></ssc:Annotation></ssd:Annotations>
</ssd:DefaultExperiment>
</ssd:SystemStructureDescription>
""" % NAMES
SSV = b"""<ssv:ParameterSet %s version="1.0" name="extra"><ssv:Parameters>
<ssv:Parameter name="k"><ssv:Real value="2" unit="mm"/></ssv:Parameter><ssv:Parameter name="n"><ssv:Integer value="7"/></ssv:Parameter>
<ssv:Parameter name="s"><ssv:String value="x"/></ssv:Parameter><ssv:Parameter name="e"><ssv:Enumeration name="x"/></ssv:Parameter>
</ssv:Parameters><ssv:Units><ssc:Unit name="mm"><ssc:BaseUnit m="1" factor="0.001"/></ssc:Unit></ssv:Units></ssv:ParameterSet>
""" % NAMES
FMI2 = b"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="a" guid="{g}" generationTool="t" numberOfEventIndicators="0">
<CoSimulation modelIdentifier="a" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUstate="true" canInterpolateInputs="false"/>
<UnitDefinitions><Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit></UnitDefinitions>
<TypeDefinitions><SimpleType name="E"><Enumeration><Item name="one" value="1"/><Item name="two" value="2"/></Enumeration></SimpleType></TypeDefinitions>
<DefaultExperiment startTime="0" stopTime="1" stepSize="0.1"/>
<ModelVariables>
<ScalarVariable name="x[1]" valueReference="0" causality="output" variability="continuous"><Real unit="mm" nominal="2"/></ScalarVariable>
<ScalarVariable name="x[2]" valueReference="1" causality="output" variability="continuous"><Real unit="mm"/></ScalarVariable>
<ScalarVariable name="u" valueReference="2" causality="input" variability="continuous"><Real start="0"/></ScalarVariable>
<ScalarVariable name="n" valueReference="0" causality="parameter" variability="fixed"><Integer start="1"/></ScalarVariable>
<ScalarVariable name="e" valueReference="1" causality="parameter" variability="fixed"><Enumeration declaredType="E" start="1"/></ScalarVariable>
<ScalarVariable name="b" valueReference="0" causality="parameter" variability="fixed"><Boolean start="true"/></ScalarVariable>
<ScalarVariable name="s" valueReference="0" causality="parameter" variability="fixed"><String start="x"/></ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="1" dependencies="3"/><Unknown index="2"/></Outputs></ModelStructure>
</fmiModelDescription>
"""
FMI3 = b"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="a" instantiationToken="{g}">
<CoSimulation modelIdentifier="a" canGetAndSetFMUState="true"/>
<UnitDefinitions><Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit></UnitDefinitions>
<DefaultExperiment stepSize="0.1"/>
<ModelVariables>
<Float64 name="x" valueReference="0" causality="output" unit="mm"><Dimension start="2"/><Dimension valueReference="3"/></Float64>
<Float64 name="u" valueReference="1" causality="input" start="0"/>
<Int32 name="n" valueReference="2" causality="parameter" variability="fixed" start="1"/>
<UInt64 name="d" valueReference="3" causality="structuralParameter" variability="fixed" start="3"/>
<Boolean name="b" valueReference="4" causality="parameter" variability="fixed" start="true"/>
</ModelVariables>
<ModelStructure><Output valueReference="0" dependencies="1"/></ModelStructure>
</fmiModelDescription>
"""
